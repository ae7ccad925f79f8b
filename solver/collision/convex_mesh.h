// Spheres, capsules, boxes and hulls against closed meshes: nodes over faces, edges that cross, minima of the
// distance.
#pragma once

#include "collision/scratch.h"

namespace pbd {

/// a as it is placed in the mesh's frame.
void convex_mesh(const RoundedPolyhedron& a, const ClosedMesh& b, const ContactWriter& writer,
                 CollisionScratch& scratch);

}  // namespace pbd
