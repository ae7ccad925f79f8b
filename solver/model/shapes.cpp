#include "shapes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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

MeshEdge mesh_edge(const Polyhedron& solid, const Polyhedron::Edge& edge) {
  const Vec3 whole = solid.x.col(edge.node[1]) - solid.x.col(edge.node[0]);
  const Vec3 &one = solid.faces[edge.face[0]].normal, &two = solid.faces[edge.face[1]].normal;
  const bool bends = !one.isZero(0) && !two.isZero(0);
  const double cosine = bends ? one.dot(two) : -1, length = whole.norm();
  return {whole / length, (one + two).normalized(), length, cosine, bends ? one.cross(two).norm() : 0};
}

/// What a mesh tells of its edges.
void add_edges(ClosedMesh& mesh) {
  const Polyhedron& solid = mesh.solid;
  mesh.first_neighbour.assign(mesh.surface.x.cols() + 1, 0);
  for (const auto& edge : solid.edges) {
    mesh.edge.push_back(mesh_edge(solid, edge));
    for (const int node : edge.node) ++mesh.first_neighbour[node + 1];
  }
  std::partial_sum(mesh.first_neighbour.begin(), mesh.first_neighbour.end(), mesh.first_neighbour.begin());
  mesh.neighbour.resize(2 * solid.edges.size());
  std::vector<int> next(mesh.first_neighbour.begin(), mesh.first_neighbour.end() - 1);
  for (const auto& edge : solid.edges)
    for (const std::size_t end : {0U, 1U}) mesh.neighbour[next[edge.node[end]]++] = edge.node[1 - end];
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
  add_edges(*this);
  inside = point_inside(surface);
  tree.build(boxes);
}

}  // namespace pbd
