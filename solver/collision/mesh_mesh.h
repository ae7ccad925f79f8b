// Two closed meshes: nodes of each over faces of the other, and edges that cross.
#pragma once

#include "collision/scratch.h"

namespace pbd {

/// Writers for contacts in b's frame and in a's; places a in b's frame and b in a's.
void mesh_mesh(const ClosedMesh& a, const ClosedMesh& b, const ContactWriter& in_b, const ContactWriter& in_a,
               CollisionScratch& scratch);

}  // namespace pbd
