// Cylinders against closed meshes, in the mesh's frame: the side as a segment with a radius, the caps' discs
// on faces, the mesh's nodes and edges on caps and rims.
#pragma once

#include "collision/scratch.h"

namespace pbd {

void cylinder_mesh(const Cylinder& cylinder, const ClosedMesh& b, const ContactWriter& writer,
                   CollisionScratch& scratch);

}  // namespace pbd
