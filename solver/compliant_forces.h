// Forces of compliant constraints as they are in a given state, without rows: J^T (-A^-1 (c + T J v)), T of
// the damping where the effect lists any.
#pragma once

#include <vector>

#include "bodies.h"

namespace pbd {

/// Adds the accelerations W J^T (-A^-1 (c + T J v)) (m/s^2) of every compliant constraint; hard ones have no
/// force by their value and add nothing.
void add_compliant_forces(const Scene& scene, const Configuration& at, const Points& v,
                          const std::vector<double>& inverse_mass, Points& acceleration);

}  // namespace pbd
