// How features, one of them of a deformable surface, pass each other. Both lines of two edges, or a point and
// the plane of a face, may pass beside the features themselves: then nothing has gone through, and the side
// that they had is the other one. Corners are taken to go straight, also those of bodies that turn.
#pragma once

#include "touching_features.h"

namespace pbd::reference {

/// True if they pass so an odd number of times. Of a corner and a face, or of two edges.
bool passes_beside(const FeaturePair& pair, const Placement& start, const Placement& at);

}  // namespace pbd::reference
