// One implicit Euler step by extended position based dynamics, as engines do it (macklin2016xpbd).
//
// From y, with no multipliers, sweeps over the elements, each at once in force. An element of energy U is one
// row c = sqrt(2 U) of compliance 1, as in the library PositionBasedDynamics: a spring's is its usual one.
//
//   dl = -(c + l/h^2) / (grad c W grad c^T + 1/h^2),   l += dl,   x += W grad c^T dl
//
// What sweeps end at meets c + l/h^2 = 0, but has been moved along the directions of all the places on its
// way: it is beside the step's solution (measured: `dual_vs_primal`). So a step is `ok` only where directions
// stay as they are (sweeping.h).
#pragma once

#include "rivals/rival.h"

namespace pbd::rivals {

/// Throws SetupError as `newton` does.
std::unique_ptr<Rival> xpbd(const Scene& scene, double h);

}  // namespace pbd::rivals
