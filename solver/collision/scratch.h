// Room for what generators compute in between, owned by the caller and kept from pair to pair, so that
// finding contacts allocates nothing once the vectors have grown. Nothing in it outlives a call of
// `generate`.
#pragma once

#include <vector>

#include "collision/contact_writer.h"
#include "collision/mesh_place.h"
#include "collision/rounded_polyhedron.h"

namespace pbd {

/// Of a polygon that is clipped (face_manifold.cpp).
struct ManifoldCorner {
  Vec3 x;
  Feature feature;  // node: of a, edge: edge i of a over side j, face: node j of b
  int i, j;
  int to;  // what leads to the next corner: an edge of a, or the complement of a side of b
};

struct CollisionScratch {
  RoundedPolyhedron a, b;                        // the shapes, placed
  std::vector<double> slopes_a, slopes_b;        // 1, of a's edges on b's faces, and of b's on a's
  std::vector<ManifoldCorner> polygon, clipped;  // of two faces
  MeshMinima minima;                             // of a mesh about a point
  std::vector<int> cut_nodes;                    // of a mesh's triangles that a shape cuts
  std::vector<int> met;                          // of a mesh's edges, the edge that was last beside it
};

}  // namespace pbd
