// Forces of compliant constraints as they are at given positions, without rows: J^T (-A^-1 c).
#pragma once

#include <vector>

#include "scene.h"

namespace pbd {

/// Adds the accelerations W J^T (-A^-1 c) (m/s^2) of every compliant constraint at x; hard ones have no force
/// by their value and add nothing.
void add_compliant_forces(const Scene& scene, const Points& x, const std::vector<double>& inverse_mass,
                          Points& acceleration);

}  // namespace pbd
