#include "shapes.h"

namespace pbd {

ClosedMesh::ClosedMesh(TriangleMesh closed)
    : surface(std::move(closed)), solid(triangle_faces(surface)), node_normals(3, surface.x.cols()) {
  node_normals.setZero();
  std::vector<AxisBox> boxes;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& node = surface.triangles[t];
    AxisBox box;
    for (std::size_t a = 0; a < 3; ++a) {
      const Vec3 corner = surface.x.col(node[a]);
      const Vec3 next = surface.x.col(node[(a + 1) % 3]) - corner,
                 last = surface.x.col(node[(a + 2) % 3]) - corner;
      const double angle = std::atan2(next.cross(last).norm(), next.dot(last));
      node_normals.col(node[a]) += angle * solid.faces[t].normal;
      box.extend(corner);
    }
    boxes.push_back(box);
  }
  node_normals.colwise().normalize();
  tree.build(boxes);
}

}  // namespace pbd
