// Faces and edges of a closed surface of triangles.
#pragma once

#include "geometry.h"

namespace pbd {

struct Polyhedron {
  /// Its corners are anticlockwise seen from outside; the side `sides[i]` goes from `corners[i]` to the next.
  struct Face {
    Vec3 normal;        // unit, outward; zero for a triangle without area
    double offset;      // normal . x on the face (m)
    std::size_t first;  // in `corners` and `sides`
    std::size_t count;
  };
  /// `face[0]` passes it from `node[0]` to `node[1]`, `face[1]` back.
  struct Edge {
    std::array<int, 2> node, face;
  };

  Points x;
  std::vector<Face> faces;
  std::vector<int> corners, sides;
  std::vector<Edge> edges;
};

/// Throws SetupError naming an edge that is not shared by two triangles passing it in opposite directions.
void require_closed(const TriangleMesh& surface);

/// A face for every triangle of a closed surface.
Polyhedron triangle_faces(const TriangleMesh& surface);

/// A face for every plane of a closed convex surface: triangles whose nodes are in one plane to 1e-9 of the
/// surface's size are one face.
Polyhedron plane_faces(const TriangleMesh& surface);

TriangleMesh box_surface(const Vec3& size);

}  // namespace pbd
