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

  /// From the nearest point to x, outward; the feature's normal where x is on it but for rounding.
  Vec3 direction(const Vec3& x) const {
    constexpr double on_it = 1e-9;  // m
    return std::abs(distance) > on_it ? Vec3((x - nearest) / distance) : normal.normalized();
  }
};

/// Of the triangle, what is nearest to x.
MeshPlace nearest_of_triangle(const ClosedMesh& mesh, int triangle, const Vec3& x);

/// What is nearest to x, if that is inside or nearer than `limit` (m).
bool nearest_of_mesh(const ClosedMesh& mesh, const Vec3& x, double limit, MeshPlace& place);

/// All features nearer than `limit` (m) to a point x outside whose distance has a minimum over the surface:
/// nothing for the edges within a flat region, unless x is over one.
void minima_of_mesh(const ClosedMesh& mesh, const Vec3& x, double limit, std::vector<MeshPlace>& found);

}  // namespace pbd
