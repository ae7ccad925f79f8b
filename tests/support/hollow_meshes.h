// Closed surfaces with hollows, and a sharp one.
#pragma once

#include "polyhedron.h"

namespace pbd::test {

/// What is left of a cube of 2 m without its quarter x > 0, y > 0.
inline TriangleMesh angle_profile() {
  const std::vector<Eigen::Vector2d> outline{{-1, -1}, {1, -1}, {1, 0}, {0, 0}, {0, 1}, {-1, 1}};
  TriangleMesh mesh;
  mesh.x.resize(3, 12);
  for (int i = 0; i < 6; ++i)
    for (const int top : {0, 1}) mesh.x.col(i + 6 * top) << outline[std::size_t(i)], 2.0 * top - 1;
  for (int i = 0; i < 6; ++i) {
    const int next = (i + 1) % 6;
    mesh.triangles.push_back({i, next, next + 6});
    mesh.triangles.push_back({i, next + 6, i + 6});
  }
  for (const std::array<int, 3>& cap :
       std::vector<std::array<int, 3>>{{3, 0, 1}, {3, 1, 2}, {3, 4, 5}, {3, 5, 0}}) {
    mesh.triangles.push_back({cap[0] + 6, cap[1] + 6, cap[2] + 6});
    mesh.triangles.push_back({cap[0], cap[2], cap[1]});
  }
  return mesh;
}

/// A cube of 1.2 m with a pyramid of 1 m on each face.
inline TriangleMesh star() {
  const TriangleMesh cube = box_surface({1.2, 1.2, 1.2});
  TriangleMesh mesh{Points(3, 14), {}};
  mesh.x.leftCols(8) = cube.x;
  for (int side = 0; side < 6; ++side)
    mesh.x.col(8 + side) = (side % 2 == 0 ? 1.6 : -1.6) * Vec3::Unit(side / 2);
  const Polyhedron faces = plane_faces(cube);
  for (const Polyhedron::Face& face : faces.faces) {
    int axis = 0;
    face.normal.cwiseAbs().maxCoeff(&axis);
    const int tip = 8 + 2 * axis + (face.normal[axis] > 0 ? 0 : 1);
    for (std::size_t k = 0; k < face.count; ++k)
      mesh.triangles.push_back(
          {faces.corners[face.first + k], faces.corners[face.first + (k + 1) % face.count], tip});
  }
  return mesh;
}

/// A blade of 2 m along x, with an edge of `angle` (rad) at z = 0 and its back at z = 1 m.
inline TriangleMesh blade(double angle) {
  const double half = std::tan(angle / 2);
  TriangleMesh mesh{Points(3, 6),
                    {{0, 1, 4}, {0, 4, 3}, {0, 2, 5}, {0, 5, 1}, {3, 4, 5}, {3, 5, 2}, {0, 3, 2}, {1, 5, 4}}};
  mesh.x.transpose() << -1, 0, 0, 1, 0, 0, -1, half, 1, -1, -half, 1, 1, -half, 1, 1, half, 1;
  return mesh;
}

}  // namespace pbd::test
