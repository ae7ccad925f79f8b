#include "support.h"

#include <algorithm>
#include <cmath>

namespace pbd::reference {
namespace {

Vec3 farthest_of(const Points& points, const Vec3& u) {
  Eigen::Index best = 0;
  (u.transpose() * points).maxCoeff(&best);
  return points.col(best);
}

/// The farthest point along `u` in the shape's frame.
struct Farthest {
  const Vec3& u;

  Vec3 operator()(std::monostate) const { return Vec3::Zero(); }
  Vec3 operator()(const Sphere& shape) const { return shape.radius * u.normalized(); }
  Vec3 operator()(const Box& shape) const { return shape.size.cwiseProduct(signs()) / 2; }
  Vec3 operator()(const Cylinder& shape) const {
    const Vec3 across(u.x(), u.y(), 0);
    return shape.radius * across.normalized() + end(shape.length);
  }
  Vec3 operator()(const Capsule& shape) const { return shape.radius * u.normalized() + end(shape.length); }
  Vec3 operator()(const ClosedMesh& shape) const { return farthest_of(shape.surface.x, u); }
  Vec3 operator()(const ConvexHull& shape) const { return farthest_of(shape.surface.x, u); }
  Vec3 operator()(const HalfSpace&) const { return Vec3::Zero(); }

  Vec3 signs() const {
    return {std::copysign(1.0, u.x()), std::copysign(1.0, u.y()), std::copysign(1.0, u.z())};
  }
  Vec3 end(double length) const { return Vec3::UnitZ() * std::copysign(length / 2, u.z()); }
};

double support(const PlacedShape& placed, const Vec3& u) {
  if (!is_half_space(*placed.shape)) return u.dot(farthest_point(placed, u));
  constexpr double same = 1e-9;  // of a unit vector that is the normal but for rounding
  const Vec3 normal = placed.frame.rotation.col(2);
  return (u - normal).norm() <= same ? u.dot(placed.frame.origin) : infinity;
}

/// Points of a - b around or beside the origin: at most four.
struct Simplex {
  std::array<Vec3, 4> point;
  std::size_t count = 0;
};

/// The point of least norm among combinations of the chosen points that are affine; true if it lies inside
/// their hull.
bool nearest_of(const Simplex& all, unsigned chosen, Vec3& nearest) {
  std::array<Vec3, 4> p;
  int n = 0;
  for (std::size_t i = 0; i < all.count; ++i)
    if ((chosen >> i & 1U) != 0) p[static_cast<std::size_t>(n++)] = all.point[i];
  Eigen::Matrix<double, 3, 3> edges = Eigen::Matrix3d::Zero();
  for (int k = 1; k < n; ++k) edges.col(k - 1) = p[static_cast<std::size_t>(k)] - p[0];
  Eigen::Matrix3d gram = edges.transpose() * edges;
  for (int k = n - 1; k < 3; ++k) gram(k, k) = 1;
  const double size = gram.diagonal().head(std::max(n - 1, 1)).prod();
  constexpr double flat = 1e-20;  // of a squared volume: its points say nothing more than fewer do
  if (n > 1 && !(gram.determinant() > flat * size)) return false;
  const Vec3 weight = -gram.inverse() * (edges.transpose() * p[0]);
  double last = 1;
  for (int k = 0; k < n - 1; ++k) {
    if (!(weight[k] >= 0)) return false;
    last -= weight[k];
  }
  nearest = p[0] + edges * weight;
  return last >= 0;
}

/// Keeps the points that the nearest point is made of.
Vec3 reduce(Simplex& simplex) {
  Vec3 best = simplex.point[0], found;
  unsigned kept = 1;
  double least = infinity;
  for (unsigned chosen = 1; chosen < 1U << simplex.count; ++chosen)
    if (nearest_of(simplex, chosen, found) && found.squaredNorm() < least) {
      least = found.squaredNorm();
      best = found;
      kept = chosen;
    }
  std::size_t count = 0;
  for (std::size_t i = 0; i < simplex.count; ++i)
    if ((kept >> i & 1U) != 0) simplex.point[count++] = simplex.point[i];
  simplex.count = count;
  return best;
}

/// How far the origin is from a convex set of which `point(n)` is the least along n.
template <class Point>
DistanceBounds distance_of(const Point& point) {
  Simplex simplex;
  simplex.point[0] = point(Vec3::UnitX());
  simplex.count = 1;
  Vec3 nearest = simplex.point[0];
  DistanceBounds bounds{0, nearest.norm()};
  constexpr int most = 200;  // as of `parts`; the bounds hold wherever it ends
  for (int step = 0; step < most && bounds.proved < bounds.found; ++step) {
    const Vec3 n = nearest / bounds.found, next = point(n);
    if (const double proved = n.dot(next); proved > bounds.proved) bounds.proved = proved, bounds.along = n;
    simplex.point[simplex.count++] = next;
    nearest = reduce(simplex);
    if (simplex.count == 4) return {0, 0};
    if (!(nearest.norm() < bounds.found)) break;
    bounds.found = nearest.norm();
  }
  return bounds;
}

Vec3 farthest_corner(const std::array<Vec3, 3>& triangle, const Vec3& u) {
  return *std::max_element(triangle.begin(), triangle.end(),
                           [&](const Vec3& x, const Vec3& y) { return u.dot(x) < u.dot(y); });
}

struct SizeOf {
  Size operator()(std::monostate) const { return {0, 0}; }
  Size operator()(const Sphere& shape) const { return {shape.radius, shape.radius}; }
  Size operator()(const Box& shape) const { return {shape.size.norm() / 2, shape.size.minCoeff() / 2}; }
  Size operator()(const Cylinder& shape) const {
    return {std::hypot(shape.radius, shape.length / 2), shape.radius};
  }
  Size operator()(const Capsule& shape) const { return {shape.radius + shape.length / 2, shape.radius}; }
  Size operator()(const ClosedMesh& shape) const { return of(shape.surface.x); }
  Size operator()(const ConvexHull& shape) const { return of(shape.surface.x); }
  Size operator()(const HalfSpace&) const { return {infinity, infinity}; }

  static Size of(const Points& x) {
    const Vec3 sides = x.rowwise().maxCoeff() - x.rowwise().minCoeff();
    return {x.colwise().norm().maxCoeff(), sides.norm() / 2};
  }
};

}  // namespace

Vec3 farthest_point(const PlacedShape& placed, const Vec3& direction) {
  const Vec3 own = placed.frame.rotation.transpose() * direction;
  return placed.frame.place(std::visit(Farthest{own}, *placed.shape));
}

double separation(const PlacedShape& a, const PlacedShape& b, const Vec3& n) {
  return -support(a, -n) - support(b, n);
}

double separation(const PlacedShape& a, const PlacedShape& b, const std::vector<Vec3>& ways) {
  double largest = -infinity;
  for (const Vec3& n : ways) largest = std::max(largest, separation(a, b, n));
  return largest;
}

Parting least_parting(const PlacedShape& a, const PlacedShape& b, const std::vector<Vec3>& ways) {
  Parting best;
  const auto better = [&](const Vec3& n) {
    if (const double apart = separation(a, b, n); apart > best.apart) best = {apart, n};
  };
  for (const Vec3& way : ways) better(way);
  if (best.apart >= 0 || is_half_space(*a.shape) || is_half_space(*b.shape)) return best;
  const double beyond = std::min(size_of(*a.shape).outer, size_of(*b.shape).outer) / 100;
  constexpr double still = 1e-12;  // of `beyond`: a step forward that is none
  for (const Vec3& way : ways) {
    Parting here{separation(a, b, way), way};
    for (double before = -infinity; here.apart > before + still * beyond;) {
      before = here.apart;
      const Vec3 shift = (beyond - before) * here.along;
      const DistanceBounds shifted = distance_of(
          [&](const Vec3& u) -> Vec3 { return farthest_point(a, -u) - farthest_point(b, u) + shift; });
      if (!(shifted.proved > 0)) break;
      here = {separation(a, b, shifted.along), shifted.along};
      if (here.apart > best.apart) best = here;
    }
  }
  return best;
}

double distance(const PlacedShape& a, const Vec3& point) {
  if (is_half_space(*a.shape)) return a.frame.rotation.col(2).dot(point - a.frame.origin);
  return distance(a, {point, point, point}).proved;
}

DistanceBounds distance(const PlacedShape& a, const std::array<Vec3, 3>& triangle) {
  return distance_of(
      [&](const Vec3& n) -> Vec3 { return farthest_point(a, -n) - farthest_corner(triangle, n); });
}

DistanceBounds distance(const Points& a, const Points& b) {
  return distance_of([&](const Vec3& n) -> Vec3 { return farthest_of(a, -n) - farthest_of(b, n); });
}

Size size_of(const Shape& shape) {
  return std::visit(SizeOf{}, shape);
}

bool is_half_space(const Shape& shape) {
  return std::holds_alternative<HalfSpace>(shape);
}

bool is_convex(const Shape& shape) {
  return !std::holds_alternative<ClosedMesh>(shape) && !std::holds_alternative<std::monostate>(shape);
}

}  // namespace pbd::reference
