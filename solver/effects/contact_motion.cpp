// How far what may touch goes in a step.
#include <algorithm>
#include <cmath>

#include "effects/contact_search.h"

namespace pbd {

/// m, from `start` to `to`: of a body's or a triangle's centre, or a node.
Vec3 ContactSearch::shift_of(const Motion& motion, const Bodies& bodies, const Points& start,
                             const Points& to) const {
  const auto shift = [&](int node) -> Vec3 { return to.col(node) - start.col(node); };
  if (motion.kind == Carrier::body) return shift(bodies.node(motion.carrier));
  if (motion.kind == Carrier::node) return shift(motion.carrier);
  const auto& [a, b, c] = effect_.triangle[motion.carrier];
  return (shift(a) + shift(b) + shift(c)) / 3;
}

Displacement ContactSearch::displacement(const Motion& motion, const Bodies& bodies,
                                         const Configuration& start, const Points& to) const {
  if (motion.kind == Carrier::triangle) return triangle_displacement(motion, start.x, to);
  const double shift = (shift_of(motion, bodies, start.x, to) - motion.course).norm();
  if (motion.kind == Carrier::node) return {shift, 0};
  const Eigen::Index column = bodies.column(motion.carrier);
  return {shift, (start.pose[motion.carrier].turn_per_arc * (to.col(column) - start.x.col(column))).norm()};
}

Frame ContactSearch::placed_frame(int collider, const Configuration& at) const {
  const Motion& motion = motions_[collider];
  if (motion.kind == Carrier::triangle) return {};
  if (motion.kind == Carrier::node) return {at.x.col(motion.carrier), Eigen::Matrix3d::Identity()};
  const Pose& pose = at.pose[motion.carrier];
  const Frame& own = effect_.collider[collider].frame;
  return {pose.x + pose.rotation * own.origin, pose.rotation * own.rotation};
}

void ContactSearch::place_colliders(const Bodies& bodies, const Configuration& start,
                                    const std::vector<double>& inverse_mass) {
  const auto moves = [&](Eigen::Index column) { return inverse_mass[column] > 0; };
  for (std::size_t k = 0; k < motions_.size(); ++k) {
    Motion& motion = motions_[k];
    if (motion.kind == Carrier::triangle) {
      place_triangle(start.x, inverse_mass, motion);
      continue;
    }
    const int carrier = motion.carrier;
    const bool is_node = motion.kind == Carrier::node;
    motion.shape = is_node ? &motion.node_shape : &effect_.collider[k].shape;
    motion.frame = placed_frame(static_cast<int>(k), start);
    motion.centre = is_node ? motion.frame.origin : start.pose[carrier].x;
    motion.moves = is_node ? moves(carrier) : moves(bodies.node(carrier)) || moves(bodies.column(carrier));
  }
}

void ContactSearch::begin(const SearchedStep& step) {
  searched_ = false;
  near_.clear();
  near_pairs_.clear();
  late_.clear();
  late_surfaces_.clear();
  tried_.clear();
  held_.clear();
  left_.clear();
  left_surfaces_.clear();
  far_.clear();
  parted_.clear();
  // Less would have more places on ways looked at, and miss more steps.
  constexpr double least = 1e-6, most = 1e-4;
  overlooked_ = effect_.continuous ? most : std::clamp(step.tolerance, least, most);
  threads_ = step.threads;
  clearance_.begin(step.bodies, step.start, step.straight);
  colliders_clear_ = clearance_.holds(step.bodies, step.start, step.free);
  if (!colliders_clear_) set_out(step);
  surface_contacts_.clear();
  surfaces_clear_ = !surfaces_ || surfaces_->stays_clear(step.start.x, step.free);
  if (!surfaces_clear_) set_surfaces_out(step);
}

void ContactSearch::set_out(const SearchedStep& step) {
  place_colliders(step.bodies, step.start, step.inverse_mass);
  for (Motion& motion : motions_) {
    motion.course = shift_of(motion, step.bodies, step.start.x, step.straight);
    const Displacement moved = displacement(motion, step.bodies, step.start, step.free);
    motion.beside = farthest_travel(motion, moved);
    motion.travel = motion.beside + room * motion.course.norm();
    motion.turn = moved.turn;
    motion.grown = true;
    if (motion.kind == Carrier::body && motion.radius > 0)
      motion.turn = std::max(moved.turn, motion.travel / motion.radius);
  }
}

void ContactSearch::set_surfaces_out(const SearchedStep& step) {
  surfaces_grown_ = true;
  surface_reach_.set_out(step.start.x, step.straight, step.free, room);
}

bool ContactSearch::extend(const SearchedStep& step, const Points& x) {
  bool farther = false;
  if (colliders_clear_ && !clearance_.holds(step.bodies, step.start, x)) {
    colliders_clear_ = false;
    farther = true;
    set_out(step);
  }
  if (surfaces_clear_ && surfaces_ && !surfaces_->stays_clear(step.start.x, x)) {
    surfaces_clear_ = false;
    farther = true;
    set_surfaces_out(step);
  }
  if (!colliders_clear_ && extend_colliders(step, x)) farther = true;
  if (!surfaces_clear_ && surface_reach_.extend(step.start.x, x, room)) surfaces_grown_ = farther = true;
  if (farther) searched_ = false;
  return farther;
}

bool ContactSearch::extend_colliders(const SearchedStep& step, const Points& x) {
  bool farther = false;
  const auto grow = [&](double& searched, double reached, bool& grown) {
    if (search_farther(searched, reached, room)) grown = farther = true;
  };
  for (Motion& motion : motions_) {
    const Displacement moved = displacement(motion, step.bodies, step.start, x);
    const double beside = farthest_travel(motion, moved);
    grow(motion.travel, beside, motion.grown);
    if (motion.grown) motion.beside = std::max(motion.beside, beside);
    grow(motion.turn, moved.turn, motion.grown);
  }
  return farther;
}

}  // namespace pbd
