#include "shapes.h"

namespace pbd {

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
  tree.build(boxes);
}

}  // namespace pbd
