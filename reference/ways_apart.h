// Directions along which convex shapes may part (support.h).
//
// What is rounded about a polyhedron, a segment or a point is as deep in another such shape as the radii make
// it along the line between what they are rounded about, or, where these meet, along a face's normal or
// across an edge of each (gottschalk1996obbtree).
#pragma once

#include "support.h"

namespace pbd::reference {

/// Unit vectors from b to a: a half space's normal, else the line of the centres, the normals of faces and,
/// if none of these parts the shapes, those above.
std::vector<Vec3> ways_apart(const PlacedShape& a, const PlacedShape& b);

}  // namespace pbd::reference
