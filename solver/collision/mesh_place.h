// The features of a closed mesh near a point, in the mesh's frame.
#pragma once

#include "shapes.h"

namespace pbd {

struct MeshPlace {
  enum class Feature { face, edge, node };

  Feature feature;
  int i;            // a triangle, or an edge or node of the polyhedron
  Vec3 nearest;     // m
  Vec3 normal;      // of the feature: of a node weighted by the faces' angles
  double distance;  // signed (m): negative inside
};

/// From the place nearest to x to x, outward; the feature's normal where x is on it but for rounding (of the
/// mesh's size).
Vec3 direction(const ClosedMesh& mesh, const MeshPlace& place, const Vec3& x);

/// Of the triangle, what is nearest to x.
MeshPlace nearest_of_triangle(const ClosedMesh& mesh, int triangle, const Vec3& x);

/// What is nearest to x, if x is inside or no farther than `limit` (m).
bool nearest_of_mesh(const ClosedMesh& mesh, const Vec3& x, double limit, MeshPlace& place);

/// What `minima_of_mesh` found, and its scratch: what is no face, and of all edges and nodes how many
/// triangles have been met that have it as their nearest point, zero in between.
struct MeshMinima {
  std::vector<MeshPlace> found, near;
  std::vector<int> seen;
};

/// All features nearer than `limit` (m) to a point x outside whose distance has a minimum over the surface:
/// nothing for the edges within a flat region, unless x is over one.
void minima_of_mesh(const ClosedMesh& mesh, const Vec3& x, double limit, MeshMinima& minima);

}  // namespace pbd
