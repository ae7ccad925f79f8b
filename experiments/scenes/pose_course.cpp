#include "scenes/pose_course.h"

#include <algorithm>

namespace pbdcheck {
namespace {

/// Of the turn from one orientation to another by the shorter way, in the axes of both (rad).
pbd::Vec3 turn_between(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) {
  const Eigen::AngleAxisd turn(from.conjugate() * to);
  return turn.angle() * turn.axis();
}

BodyVelocity between(const BodyPose& from, const BodyPose& to, double duration) {
  return {(to.place - from.place) / duration, turn_between(from.orientation, to.orientation) / duration};
}

}  // namespace

BodyPose PoseCourse::at(double time) const {
  const auto next = std::upper_bound(time_.begin(), time_.end(), time) - time_.begin();
  if (next == std::ssize(time_)) return pose_.back();
  const auto k = static_cast<std::size_t>(next);
  const double share = (time - time_[k - 1]) / (time_[k] - time_[k - 1]);
  const auto &from = pose_[k - 1], &to = pose_[k];
  return {from.place + share * (to.place - from.place), from.orientation.slerp(share, to.orientation)};
}

BodyVelocity PoseCourse::over(double begin, double end, const BodyPose& from) const {
  if (begin >= time_.back()) return {pbd::Vec3::Zero(), pbd::Vec3::Zero()};
  const auto k =
      static_cast<std::size_t>(std::upper_bound(time_.begin(), time_.end(), begin) - time_.begin());
  if (end <= time_[k]) return between(pose_[k - 1], pose_[k], time_[k] - time_[k - 1]);
  return between(from, at(end), end - begin);
}

}  // namespace pbdcheck
