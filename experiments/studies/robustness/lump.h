// Random polyhedra.
#pragma once

#include "geometry.h"
#include "studies/robustness/random.h"

namespace pbdcheck {

/// The hull of 6 to 12 directions out to at most 0.4 m, as it is or with each corner drawn in by up to a
/// half: then it has hollows. All of it is seen from the origin.
pbd::TriangleMesh lump(Random& random, bool hollow);

}  // namespace pbdcheck
