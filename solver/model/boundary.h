// The surface of a mesh of tetrahedra.
#pragma once

#include "mesh.h"

namespace pbd {

/// The faces that one tetrahedron alone has, anticlockwise seen from outside, in the order of their nodes.
std::vector<std::array<int, 3>> boundary(const TetMesh& mesh);

}  // namespace pbd
