// How deep a closed mesh and another shape are in each other at least: a proof for each point that both hold.
//
//   sd(x)  the signed distance of x from a shape's surface (m), negative inside: 1-Lipschitz, so that a shape
//          that holds the ball of radius r about x has to go at least r - sd(x) to leave the other one
//
// x are nodes, the middles of triangles and of what of an edge lies between two triangles of the mesh, and
// points on the axes of what is round; of a mesh in a convex shape all points of its triangles: -sd is
// concave there. Of a mesh |sd| is the distance of the nearest triangle, its sign that of mesh_points.h.
//
// Limits: meshes may be deeper in each other than these points are, and so may what is round in a mesh. A
// triangle of a surface that an edge of the mesh goes through, or that has an edge through the mesh, is told
// as no deeper than its corners and middle are, or its radius.
#pragma once

#include "support.h"

namespace pbd::reference {

/// The depth (m) that some point proves, at least one shape a closed mesh and none a half space; `floor`
/// where none proves more.
double proved_depth(const PlacedShape& a, const PlacedShape& b, double floor = 0);

/// Of a closed mesh in a triangle that keeps `radius` (m) free on both of its sides: `radius` at least where
/// an edge of one goes through the other.
double proved_depth(const PlacedShape& mesh, const std::array<Vec3, 3>& triangle, double radius);

}  // namespace pbd::reference
