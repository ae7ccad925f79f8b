#include "effects/clearance.h"

#include <algorithm>
#include <cmath>

#include "collision/bounds.h"

namespace pbd {
namespace {

constexpr double with_room = 1 + search_room;

/// m, that no column went farther; NaN if one is. By the largest coordinate, which is quick.
double farthest(const Points& from, const Points& to, Eigen::Index columns) {
  const auto way = to.leftCols(columns) - from.leftCols(columns);
  return columns == 0 ? 0 : std::sqrt(3.0) * way.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
}

AxisBox grown(const AxisBox& box, double distance) {
  return {box.min() - Vec3::Constant(distance), box.max() + Vec3::Constant(distance)};
}

bool is_finite(const AxisBox& box) {
  return box.min().allFinite() && box.max().allFinite();
}

/// m, of a box's lowest point.
double height_above(const Frame& half_space, const AxisBox& box) {
  const Vec3 normal = half_space.rotation.col(2);
  return normal.dot(box.center() - half_space.origin) - normal.cwiseAbs().dot(box.sizes()) / 2;
}

bool may_meet(const std::vector<MovingBox>& boxes, int i, int j, const Clearance::MayTouch& may_touch) {
  const MovingBox &one = boxes[i], &two = boxes[j];
  return (one.moves || two.moves) && one.group != two.group && may_touch(std::min(i, j), std::max(i, j));
}

}  // namespace

double farthest_point(const Collider& collider) {
  return collider.frame.origin.norm() + bounding_radius(collider.shape);
}

Clearance::Clearance(const Contact& effect) : effect_(effect) {
  for (const Collider& collider : effect.collider) radius_.push_back(farthest_point(collider));
}

void Clearance::begin(const Bodies& bodies, const Configuration& start, const Points& straight) {
  if (distance_ == 0) return;
  const Eigen::Index nodes = bodies.nodes();
  // A way is what goes beside its course: that counts twice.
  spent_ = farthest(x_, start.x, nodes) + 2 * with_room * farthest(start.x, straight, nodes);
}

bool Clearance::holds(const Bodies& bodies, const Configuration& start, const Points& to) const {
  if (distance_ == 0) return false;
  double turned = 0;  // m, that turns move points of bodies
  for (std::size_t k = 0; k < radius_.size(); ++k) {
    const int body = effect_.collider[k].body;
    const Eigen::Index column = bodies.column(body);
    const Pose& now = start.pose[body];
    const double turn = (now.rotation - pose_[body].rotation).norm() +
                        (now.turn_per_arc * (to.col(column) - start.x.col(column))).norm();
    if (turn == 0) continue;
    const double moved = radius_[k] * turn;
    if (!std::isfinite(moved)) return false;  // a half space has no farthest point
    turned = std::max(turned, moved);
  }
  return spent_ + with_room * (farthest(start.x, to, bodies.nodes()) + turned) < distance_;
}

/// m, of the lowest box above a half space that it may meet; minus infinity if that moves, or another box is
/// infinite.
double Clearance::above_half_spaces(const std::vector<MovingBox>& boxes, const std::vector<Pose>& pose,
                                    const MayTouch& may_touch) const {
  double lowest = infinity;
  for (int i = 0; i < static_cast<int>(boxes.size()); ++i) {
    if (is_finite(boxes[i].box)) continue;
    const bool fixed = i < static_cast<int>(effect_.collider.size()) && !boxes[i].moves &&
                       std::holds_alternative<HalfSpace>(effect_.collider[i].shape);
    if (!fixed) return -infinity;
    const Collider& collider = effect_.collider[i];
    const Pose& at = pose[collider.body];
    const Frame half_space{at.x + at.rotation * collider.frame.origin, at.rotation * collider.frame.rotation};
    for (int j = 0; j < static_cast<int>(boxes.size()); ++j)
      if (is_finite(boxes[j].box) && may_meet(boxes, i, j, may_touch))
        lowest = std::min(lowest, height_above(half_space, boxes[j].box));
  }
  return lowest;
}

/// True if no finite boxes that may meet are nearer than twice that (m). Of boxes of different groups one is
/// not of the last one's, which are nodes and triangles: the others are in the tree.
bool Clearance::none_within(double distance, const std::vector<MovingBox>& boxes, const MayTouch& may_touch) {
  boxes_.clear();
  owner_.clear();
  for (int i = 0; i < static_cast<int>(boxes.size()); ++i)
    if (boxes[i].group != boxes.back().group && is_finite(boxes[i].box)) {
      boxes_.push_back(grown(boxes[i].box, distance));
      owner_.push_back(i);
    }
  tree_.build(boxes_);
  for (int i = 0; i < static_cast<int>(boxes.size()); ++i) {
    if (!is_finite(boxes[i].box)) continue;
    AxisBox box = grown(boxes[i].box, distance);
    bool met = false;
    tree_.find(box, [&](int k) {
      if (!may_meet(boxes, i, owner_[k], may_touch)) return;
      met = true;
      box.setEmpty();  // no more of them
    });
    if (met) return false;
  }
  return true;
}

void Clearance::look(const std::vector<MovingBox>& boxes, const Configuration& start, double way,
                     const MayTouch& may_touch) {
  distance_ = 0;
  if (to_wait_ > 0) {
    --to_wait_;
    return;
  }
  const double above = above_half_spaces(boxes, start.pose, may_touch);
  for (const double ways : {4096, 256, 16}) {  // the fewer, the sooner it is looked again
    if (!(way > 0) || !(ways * way < above) || !none_within(ways * way, boxes, may_touch)) continue;
    distance_ = ways * way;
    x_ = start.x;
    pose_ = start.pose;
    return;
  }
  to_wait_ = 32;  // what is near is not soon far
}

}  // namespace pbd
