#include "mesh_points.h"

#include <algorithm>
#include <numbers>

namespace pbd::reference {
namespace {

/// The triangle as it is seen from x, sr.
double solid_angle(const Vec3& x, const std::array<Vec3, 3>& corner) {
  const Vec3 a = corner[0] - x, b = corner[1] - x, c = corner[2] - x;
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace

std::array<Vec3, 3> corners(const ClosedMesh& mesh, const std::array<int, 3>& triangle) {
  return {mesh.surface.x.col(triangle[0]), mesh.surface.x.col(triangle[1]), mesh.surface.x.col(triangle[2])};
}

double distance_of_segment(const Vec3& x, const Segment& segment) {
  const Vec3 along = segment.to - segment.from;
  const double length = along.squaredNorm();
  const double share = length > 0 ? std::clamp(along.dot(x - segment.from) / length, 0.0, 1.0) : 0.0;
  return (x - segment.from - share * along).norm();
}

bool is_over(const Vec3& x, const std::array<Vec3, 3>& corner) {
  const Vec3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
  for (std::size_t k = 0; k < 3; ++k)
    if (!(normal.dot((corner[(k + 1) % 3] - corner[k]).cross(x - corner[k])) >= 0)) return false;
  return normal.squaredNorm() > 0;
}

double distance_of_triangle(const Vec3& x, const std::array<Vec3, 3>& corner) {
  const Vec3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
  if (is_over(x, corner)) return std::abs(normal.dot(x - corner[0]));
  double least = infinity;
  for (std::size_t k = 0; k < 3; ++k)
    least = std::min(least, distance_of_segment(x, {corner[k], corner[(k + 1) % 3]}));
  return least;
}

bool holds(const ClosedMesh& mesh, const Vec3& x) {
  if (!mesh.box.contains(x)) return false;
  double all = 0;
  for (const auto& triangle : mesh.surface.triangles) all += solid_angle(x, corners(mesh, triangle));
  return all > 2 * std::numbers::pi;
}

double distance_of_mesh(const ClosedMesh& mesh, const Vec3& x) {
  double least = infinity;
  for (double reach = mesh.size / 64; std::isinf(least); reach *= 2) {
    AxisBox box(x.array() - reach, x.array() + reach);
    mesh.tree.find(box, [&](int triangle) {
      const auto& nodes = mesh.surface.triangles[static_cast<std::size_t>(triangle)];
      const double here = distance_of_triangle(x, corners(mesh, nodes));
      if (here <= reach) least = std::min(least, here);
    });
  }
  return least;
}

double crossing(const Segment& segment, const std::array<Vec3, 3>& corner) {
  const Vec3 along = segment.to - segment.from;
  const Vec3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
  const double from = normal.dot(segment.from - corner[0]), to = normal.dot(segment.to - corner[0]);
  if (!(from * to < 0)) return infinity;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 side = corner[(k + 1) % 3] - corner[k];
    if (along.dot((corner[k] - segment.from).cross(side)) * (from - to) > 0) return infinity;
  }
  return from / (from - to);
}

std::vector<double> crossings(const ClosedMesh& mesh, const Segment& segment) {
  std::vector<double> shares{0, 1};
  AxisBox box(segment.from);
  box.extend(segment.to);
  mesh.tree.find(box, [&](int triangle) {
    const auto& nodes = mesh.surface.triangles[static_cast<std::size_t>(triangle)];
    if (const double share = crossing(segment, corners(mesh, nodes)); share < 1) shares.push_back(share);
  });
  std::sort(shares.begin(), shares.end());
  return shares;
}

}  // namespace pbd::reference
