// The face of a that looks at a face of b, clipped by that face's sides (sutherland1974reentrant): corners
// are nodes of a, crossings of edges, and nodes of b.
#pragma once

#include "collision/scratch.h"

namespace pbd {

/// Where the part of a that faces b's face f is above that face, gaps at least `floor` (m).
void face_manifold(const RoundedPolyhedron& a, const RoundedPolyhedron& b, int f, double floor,
                   const ContactWriter& writer, CollisionScratch& scratch);

}  // namespace pbd
