#include "studies/robustness/passage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/body_shapes.h"
#include "support.h"

namespace pbdcheck {

using namespace pbd;

namespace {

constexpr double touching = 1e-9;  // of the sizes: cores that are no farther apart meet
// Of the farthest way in a step, hindered or not: what a tolerance of 1e-8 leaves where one is a thousand
// times as heavy as the other, 2 sqrt(1000) 1e-8, rounded up.
constexpr double solved = 1e-6;

struct PiecesOf {
  double share;
  Core& core;

  void operator()(std::monostate) const {}
  void operator()(const Sphere& shape) const { rounded(Points::Zero(3, 1), shape.radius); }
  void operator()(const Box& shape) const { core.piece.push_back(share * box_surface(shape.size).x); }
  void operator()(const Cylinder& shape) const {
    constexpr double sides = 32;  // of the prism inside
    const double about = shape.radius / std::cos(std::numbers::pi / sides);
    core.piece.push_back(share * surface_of(Cylinder{share < 1 ? shape.radius : about, shape.length}).x);
  }
  void operator()(const Capsule& shape) const {
    Points ends = Points::Zero(3, 2);
    ends.row(2) << -shape.length / 2, shape.length / 2;
    rounded(ends, shape.radius);
  }
  void operator()(const ConvexHull& shape) const { core.piece.push_back(share * shape.surface.x); }
  void operator()(const ClosedMesh& shape) const {
    for (const auto& [i, j, k] : shape.surface.triangles) {
      Points corners(3, 3);
      corners << shape.surface.x.col(i), shape.surface.x.col(j), shape.surface.x.col(k);
      core.piece.push_back(share * corners);
    }
  }
  void operator()(const HalfSpace&) const {
    core.plane = true;
    core.piece.emplace_back(Points::Zero(3, 1));
  }

  void rounded(const Points& points, double radius) const {
    core.piece.push_back(share * points);
    core.radius = share * radius;
  }
};

/// A core on the way between two states.
class MovingCore {
 public:
  MovingCore(const Scene& scene, const Core& core, const State& from, const State& to)
      : core_(core), from_(from), to_(to) {
    if (core.body < 0) return;
    const auto body = static_cast<std::size_t>(core.body);
    node_ = scene.bodies[body].node;
    begin_ = from.orientation[body];
    const Eigen::AngleAxisd least(begin_.conjugate() * to.orientation[body]);
    const double told = (to.time - from.time) * to.spin.col(core.body).dot(least.axis());
    constexpr double round = 2 * std::numbers::pi;
    turn_ = (least.angle() + round * std::round((told - least.angle()) / round)) * least.axis();
  }

  Points at(std::size_t piece, double share) const {
    if (core_.body < 0) {
      Points x(3, static_cast<Eigen::Index>(core_.node[piece].size()));
      for (Eigen::Index k = 0; k < x.cols(); ++k) x.col(k) = of_node(node_of(piece, k), share);
      return x;
    }
    const Eigen::AngleAxisd turned(share * turn_.norm(), turn_.stableNormalized());
    return ((begin_ * turned).toRotationMatrix() * core_.piece[piece]).colwise() + of_node(node_, share);
  }

  /// m a way, by which a piece at most goes along n.
  double rate(std::size_t piece, const Vec3& n) const {
    if (core_.body >= 0)
      return n.dot(shift(node_)) +
             turn_.norm() * std::sqrt(core_.piece[piece].colwise().squaredNorm().maxCoeff());
    double most = -infinity;
    for (const int node : core_.node[piece]) most = std::max(most, n.dot(shift(node)));
    return most;
  }

  double radius() const { return core_.radius; }

 private:
  int node_of(std::size_t piece, Eigen::Index k) const {
    return core_.node[piece][static_cast<std::size_t>(k)];
  }
  Vec3 shift(int node) const { return to_.x.col(node) - from_.x.col(node); }
  Vec3 of_node(int node, double share) const { return from_.x.col(node) + share * shift(node); }

  const Core& core_;
  const State &from_, &to_;
  int node_ = -1;
  Eigen::Quaterniond begin_;
  Vec3 turn_ = Vec3::Zero();  // rad, in the body's axes
};

Vec3 middle(const Points& x) {
  return (x.rowwise().maxCoeff() + x.rowwise().minCoeff()) / 2;
}

/// Along n, m.
double gap_along(const Points& a, const Points& b, const Vec3& n) {
  return (n.transpose() * a).minCoeff() - (n.transpose() * b).maxCoeff();
}

bool pieces_meet(const MovingCore& a, std::size_t i, const MovingCore& b, std::size_t j) {
  const double rounded = a.radius() + b.radius();
  const auto shift_along = [&](const Vec3& n) { return a.rate(i, -n) + b.rate(j, n); };
  Points xa = a.at(i, 0), xb = b.at(j, 0);
  // Most are cleared along the line of their middles.
  const Vec3 between = (middle(xa) - middle(xb)).normalized();
  if (gap_along(xa, xb, between) - rounded > shift_along(between)) return false;
  const double size = (xa.rowwise().maxCoeff() - xa.rowwise().minCoeff()).norm() +
                      (xb.rowwise().maxCoeff() - xb.rowwise().minCoeff()).norm() + rounded;
  for (double share = 0; share < 1; xa = a.at(i, share), xb = b.at(j, share)) {
    const reference::DistanceBounds distance = reference::distance(xa, xb);
    const double gap = distance.proved - rounded;
    if (!(gap > touching * size)) return true;
    const double rate = shift_along(distance.along);
    if (!(rate > gap)) return false;
    share = std::min(share + gap / rate, 1.0);
  }
  return !(reference::distance(xa, xb).proved - rounded > touching * size);
}

/// m: of a's points over the half space b.
double least_height(const Scene& scene, const Core& a, const Core& b, const State& at) {
  const MovingCore moving(scene, a, at, at), plane(scene, b, at, at);
  const Vec3 normal = at.orientation[static_cast<std::size_t>(b.body)] * b.normal;
  double least = infinity;
  for (std::size_t i = 0; i < a.pieces(); ++i)
    least = std::min(least, gap_along(moving.at(i, 0), plane.at(0, 0), normal) - a.radius);
  return least;
}

}  // namespace

Core core_of(const Collider& collider, double share) {
  Core core;
  core.body = collider.body;
  std::visit(PiecesOf{share, core}, collider.shape);
  for (Points& x : core.piece) x = (collider.frame.rotation * x).colwise() + collider.frame.origin;
  core.normal = collider.frame.rotation.col(2);
  return core;
}

Core core_of(int node, double radius, double share) {
  Core core;
  core.node = {{node}};
  core.radius = share * radius;
  return core;
}

Core core_of(const std::vector<std::array<int, 3>>& triangles) {
  Core core;
  for (const auto& triangle : triangles) core.node.emplace_back(triangle.begin(), triangle.end());
  return core;
}

double apart(const Scene& scene, const Core& a, const Core& b, const State& at) {
  if (b.plane) return std::max(0.0, least_height(scene, a, b, at));
  const MovingCore one(scene, a, at, at), two(scene, b, at, at);
  double least = infinity;
  for (std::size_t i = 0; i < a.pieces(); ++i)
    for (std::size_t j = 0; j < b.pieces(); ++j)
      least = std::min(least, reference::distance(one.at(i, 0), two.at(j, 0)).proved);
  return std::max(0.0, least - a.radius - b.radius);
}

bool pass_through(const Scene& scene, const Core& a, const Core& b, const State& from, const State& to) {
  if (b.plane) {
    const auto farthest = [](const Points& ways) { return ways.colwise().norm().maxCoeff(); };
    const double way = std::max(farthest(to.x - from.x), (to.time - from.time) * farthest(from.v));
    constexpr double rounding = 1e-12;  // of a coordinate
    return least_height(scene, a, b, to) < -(solved * way + rounding * to.x.cwiseAbs().maxCoeff());
  }
  const MovingCore one(scene, a, from, to), two(scene, b, from, to);
  for (std::size_t i = 0; i < a.pieces(); ++i)
    for (std::size_t j = 0; j < b.pieces(); ++j)
      if (pieces_meet(one, i, two, j)) return true;
  return false;
}

}  // namespace pbdcheck
