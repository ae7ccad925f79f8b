// Poses of a moving body over time. Between two of them its centre of mass goes straight, and it turns at a
// constant rate by the shorter way: by spherical interpolation. It stands still after the last.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "geometry.h"

namespace pbdcheck {

/// Of a body's frame: the place of its centre of mass (m), and the rotation from its axes to the world's.
struct BodyPose {
  pbd::Vec3 place;
  Eigen::Quaterniond orientation;
};

/// Of its centre of mass (m/s), and in its own axes (rad/s).
struct BodyVelocity {
  pbd::Vec3 velocity, spin;
};

class PoseCourse {
 public:
  /// From time 0 on.
  explicit PoseCourse(const BodyPose& start) : time_{0}, pose_{start} {}

  /// The pose at a time (s) after the last one.
  void add(double time, const BodyPose& pose) {
    time_.push_back(time);
    pose_.push_back(pose);
  }
  double last() const { return time_.back(); }

  /// The constant velocities that lead from a pose at `begin` to that of the course at `end` (s). Between two
  /// poses they are the same for every step, so that integrators do not begin anew.
  BodyVelocity over(double begin, double end, const BodyPose& from) const;

 private:
  BodyPose at(double time) const;

  std::vector<double> time_;
  std::vector<BodyPose> pose_;
};

}  // namespace pbdcheck
