// How deep a closed mesh and another shape are in each other at least: a proof for each point that both hold.
//
//   sd(x)  the signed distance of x from a shape's surface (m), negative inside: 1-Lipschitz, so that a shape
//          that holds the ball of radius r about x has to go at least r - sd(x) to leave the other one
//
// x are nodes, the middles of triangles and of what of an edge lies between two triangles of the mesh, and
// points on the axes of what is round; of a mesh in a convex shape all points of its triangles: -sd is
// concave there. Of a mesh |sd| is the distance of the nearest triangle (ericson2005collision, 5.1.5), its
// sign that of 1/2 - w, w the winding number: the sum of the triangles' solid angles over 4 pi
// (vanoosterom1983solid).
//
// Limits: meshes may be deeper in each other than these points are, and so may what is round in a mesh. A
// triangle of a surface is in a mesh by its corners and middle, or where an edge of the mesh goes through it,
// by its radius at most; by an edge of its own that goes through the mesh alone it is not.
#pragma once

#include "support.h"

namespace pbd::reference {

/// The depth (m) that some point proves, at least one shape a closed mesh and none a half space; `floor`
/// where none proves more.
double proved_depth(const PlacedShape& a, const PlacedShape& b, double floor = 0);

/// Of a closed mesh in a triangle that keeps `radius` (m) free on both of its sides: `radius` at least where
/// one of the mesh's edges goes through it.
double proved_depth(const PlacedShape& mesh, const std::array<Vec3, 3>& triangle, double radius);

}  // namespace pbd::reference
