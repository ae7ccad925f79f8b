// Signed distance of convex shapes by brute force: what is within a radius of the hull of a few points.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "collision/contact_point.h"
#include "mesh.h"

namespace pbd::test {

/// Nodes of triangles in the world; none for a point or a segment.
struct Convex {
  std::vector<Vec3> x;
  std::vector<std::array<int, 3>> triangles;
  double radius = 0;

  Vec3 node(int i) const { return x[static_cast<std::size_t>(i)]; }
  std::vector<std::array<Vec3, 2>> edges() const {
    std::vector<std::array<Vec3, 2>> found;
    if (triangles.empty()) found.push_back({x.front(), x.back()});
    for (const auto& t : triangles)
      for (std::size_t k = 0; k < 3; ++k)
        if (t[k] < t[(k + 1) % 3]) found.push_back({node(t[k]), node(t[(k + 1) % 3])});
    return found;
  }
  Vec3 normal(const std::array<int, 3>& t) const {
    return (node(t[1]) - node(t[0])).cross(node(t[2]) - node(t[0])).normalized();
  }
};

inline double to_segment(const Vec3& x, const Vec3& p, const Vec3& q) {
  const double whole = (q - p).squaredNorm();
  const double part = whole > 0 ? std::clamp((x - p).dot(q - p) / whole, 0.0, 1.0) : 0.0;
  return (x - p - part * (q - p)).norm();
}

/// The minimum over both is on an end of one, or inside both, where the difference is across both.
inline double between_segments(const std::array<Vec3, 2>& a, const std::array<Vec3, 2>& b) {
  double least = std::min(std::min(to_segment(a[0], b[0], b[1]), to_segment(a[1], b[0], b[1])),
                          std::min(to_segment(b[0], a[0], a[1]), to_segment(b[1], a[0], a[1])));
  const Vec3 along_a = a[1] - a[0], along_b = b[1] - b[0], across = along_a.cross(along_b);
  if (across.squaredNorm() > 1e-20 * along_a.squaredNorm() * along_b.squaredNorm()) {
    Eigen::Matrix3d system;
    system << along_a, -along_b, across;
    const Vec3 solved = system.partialPivLu().solve(b[0] - a[0]);
    if (solved.head<2>().minCoeff() >= 0 && solved.head<2>().maxCoeff() <= 1)
      least = std::min(least, std::abs(solved[2]) * across.norm());
  }
  return least;
}

inline double to_triangle(const Vec3& x, const Vec3& p, const Vec3& q, const Vec3& r) {
  double least = std::min({to_segment(x, p, q), to_segment(x, q, r), to_segment(x, r, p)});
  Eigen::Matrix3d system;
  system << q - p, r - p, (q - p).cross(r - p);
  const Vec3 solved = system.partialPivLu().solve(x - p);
  if (solved[0] >= 0 && solved[1] >= 0 && solved[0] + solved[1] <= 1)
    least = std::min(least, std::abs(solved[2]) * system.col(2).norm());
  return least;
}

/// How far a is from b along the unit vector n, whichever way.
inline double apart_along(const Convex& a, const Convex& b, const Vec3& n) {
  double low_a = infinity, high_a = -infinity, low_b = infinity, high_b = -infinity;
  for (const Vec3& x : a.x) low_a = std::min(low_a, n.dot(x)), high_a = std::max(high_a, n.dot(x));
  for (const Vec3& x : b.x) low_b = std::min(low_b, n.dot(x)), high_b = std::max(high_b, n.dot(x));
  return std::max(low_a - high_b, low_b - high_a);
}

/// Overlapping ones (one has a volume): the largest over all faces' normals and edges' products.
inline double signed_distance(const Convex& a, const Convex& b) {
  double apart = -infinity;
  const auto edges_a = a.edges(), edges_b = b.edges();
  for (const auto& t : a.triangles) apart = std::max(apart, apart_along(a, b, a.normal(t)));
  for (const auto& t : b.triangles) apart = std::max(apart, apart_along(a, b, b.normal(t)));
  if (apart <= 0 && apart > -infinity)
    for (const auto& i : edges_a)
      for (const auto& j : edges_b) {
        const Vec3 across = (i[1] - i[0]).cross(j[1] - j[0]);
        if (across.norm() > 1e-9 * (i[1] - i[0]).norm() * (j[1] - j[0]).norm())
          apart = std::max(apart, apart_along(a, b, across.normalized()));
      }
  if (apart <= 0 && apart > -infinity) return apart - a.radius - b.radius;
  double least = infinity;
  for (const auto& i : edges_a)
    for (const auto& j : edges_b) least = std::min(least, between_segments(i, j));
  for (const auto& t : b.triangles)
    for (const Vec3& x : a.x)
      least = std::min(least, to_triangle(x, b.node(t[0]), b.node(t[1]), b.node(t[2])));
  for (const auto& t : a.triangles)
    for (const Vec3& x : b.x)
      least = std::min(least, to_triangle(x, a.node(t[0]), a.node(t[1]), a.node(t[2])));
  return least - a.radius - b.radius;
}

}  // namespace pbd::test
