// Spheres, capsules, boxes and hulls against each other: separating axes; the clipped polygon of the faces
// that look at each other, all its corners; else the nearest features.
#pragma once

#include "collision/scratch.h"

namespace pbd {

void convex_convex(const RoundedPolyhedron& a, const RoundedPolyhedron& b, const ContactWriter& writer,
                   CollisionScratch& scratch);

}  // namespace pbd
