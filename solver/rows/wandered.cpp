#include "rows/wandered.h"

#include <cmath>
#include <utility>

#include "geometry.h"
#include "rows/source.h"

namespace pbd {

SeenBodies::SeenBodies(std::vector<int> bodies) : body_(std::move(bodies)) {
  std::sort(body_.begin(), body_.end());
  body_.erase(std::unique(body_.begin(), body_.end()), body_.end());
}

void SeenBodies::see(const Configuration& at) {
  pose_.clear();
  for (const int body : body_) pose_.push_back(at.pose[body]);
  time_ = at.time;
}

Wandered SeenBodies::wandered(const Configuration& to) const {
  double way = 0, turn = 0;  // squared
  for (std::size_t k = 0; k < pose_.size(); ++k) {
    const Pose &from = pose_[k], &now = to.pose[body_[k]];
    way = larger(way, (now.x - from.x).squaredNorm());
    turn = larger(turn, (now.rotation - from.rotation).squaredNorm() / 2);  // singular values: two, and 0
  }
  return {std::sqrt(way), std::sqrt(turn), std::abs(to.time - time_)};
}

Wandered SeenBodies::free_motion(const StepBegin& begin) const {
  const StepMap& map = begin.map;
  const auto motion = [&](Eigen::Index column) {
    return Vec3(map.x0.col(column) + map.d * map.v_free.col(column) - begin.at.x.col(column));
  };
  double way = 0, angle = 0;  // squared
  for (const int body : body_) {
    way = larger(way, motion(begin.bodies.node(body)).squaredNorm());
    const Vec3 arc = motion(begin.bodies.column(body));
    angle = larger(angle, (begin.at.pose[body].turn_per_arc * arc).squaredNorm());
  }
  return {std::sqrt(way), std::sqrt(angle), map.h};  // |R' - R| = 2 sin(angle/2)
}

}  // namespace pbd
