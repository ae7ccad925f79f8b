// Where a shape and a closed mesh overlap without a node or a crossing that tells how deep.
#pragma once

#include "collision/mesh_pair.h"

namespace pbd {

/// Of the mesh's faces that are cut, and of a's, that along whose normal they overlap least, where nothing of
/// what is written tells it.
void write_overlap(const MeshPair& pair);

}  // namespace pbd
