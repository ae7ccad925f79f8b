#include "shapes.h"

#include <algorithm>
#include <cmath>

namespace pbd {
namespace {

/// How far behind x a triangle is, along the unit vector; infinite where it is not (m).
double behind(const TriangleMesh& surface, const std::array<int, 3>& node, const Vec3& x, const Vec3& along) {
  const Vec3 corner = surface.x.col(node[0]), u = surface.x.col(node[1]) - corner,
             v = surface.x.col(node[2]) - corner, from = x - corner;
  const double volume = u.cross(v).dot(along);
  if (volume == 0) return infinity;
  const double second = along.cross(v).dot(from) / -volume, third = along.dot(u.cross(from)) / volume;
  const double distance = -u.cross(v).dot(from) / volume;
  constexpr double slack = 1e-9;  // an edge hides nothing
  return std::min({second, third, 1 - second - third}) >= -slack && distance > 0 ? distance : infinity;
}

/// Half way from the middle of the largest triangle to what is behind it; that middle if nothing is.
Vec3 point_inside(const TriangleMesh& surface) {
  double most = 0;
  Vec3 middle = surface.x.cols() > 0 ? Vec3(surface.x.rowwise().mean()) : Vec3(Vec3::Zero()),
       inward = Vec3::Zero();
  std::size_t largest = surface.triangles.size();
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& [a, b, c] = surface.triangles[t];
    const Vec3 corner = surface.x.col(a),
               across = Vec3(surface.x.col(b) - corner).cross(surface.x.col(c) - corner);
    if (!(across.norm() > most)) continue;
    most = across.norm();
    middle = (corner + surface.x.col(b) + surface.x.col(c)) / 3;
    inward = -across / most;
    largest = t;
  }
  double nearest = infinity;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if (t != largest) nearest = std::min(nearest, behind(surface, surface.triangles[t], middle, inward));
  return std::isfinite(nearest) ? Vec3(middle + nearest / 2 * inward) : middle;
}

}  // namespace

ClosedMesh::ClosedMesh(TriangleMesh closed)
    : surface(std::move(closed)), solid(triangle_faces(surface)), node_normals(3, surface.x.cols()) {
  for (Eigen::Index i = 0; i < surface.x.cols(); ++i) box.extend(Vec3(surface.x.col(i)));
  size = box.isEmpty() ? 0.0 : box.diagonal().norm();
  node_normals.setZero();
  std::vector<AxisBox> boxes;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& node = surface.triangles[t];
    AxisBox bounds;
    for (std::size_t a = 0; a < 3; ++a) {
      const Vec3 corner = surface.x.col(node[a]);
      const Vec3 next = surface.x.col(node[(a + 1) % 3]) - corner,
                 last = surface.x.col(node[(a + 2) % 3]) - corner;
      const double angle = std::atan2(next.cross(last).norm(), next.dot(last));
      node_normals.col(node[a]) += angle * solid.faces[t].normal;
      bounds.extend(corner);
    }
    boxes.push_back(bounds);
  }
  node_normals.colwise().normalize();
  inside = point_inside(surface);
  tree.build(boxes);
}

}  // namespace pbd
