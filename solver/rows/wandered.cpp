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

/// to(column) is where a column ends.
template <class At>
Wandered SeenBodies::way(const StepBegin& begin, At&& to) const {
  double way = 0, angle = 0;  // squared
  for (const int body : body_) {
    const Eigen::Index node = begin.bodies.node(body), rotation = begin.bodies.column(body);
    way = larger(way, (to(node) - begin.at.x.col(node)).squaredNorm());
    const Vec3 arc = to(rotation) - begin.at.x.col(rotation);
    angle = larger(angle, (begin.at.pose[body].turn_per_arc * arc).squaredNorm());
  }
  return {std::sqrt(way), std::sqrt(angle), begin.map.h};  // |R' - R| = 2 sin(angle/2)
}

Wandered SeenBodies::way_of_step(const StepBegin& begin, const Points& to) const {
  return way(begin, [&](Eigen::Index column) -> Vec3 { return to.col(column); });
}

Wandered SeenBodies::free_motion(const StepBegin& begin) const {
  const StepMap& map = begin.map;
  return way(begin, [&](Eigen::Index column) -> Vec3 {
    return map.x0.col(column) + map.d * map.v_free.col(column);
  });
}

}  // namespace pbd
