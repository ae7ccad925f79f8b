// From effects to rows: b = c(x_k)/d - J v_k, Sigma = A/(s d), N_ii^-1, at the positions x_k = x0 + d v_k.
#pragma once

#include "integrators.h"
#include "rows.h"

namespace pbd {

/// Allocates the rows of every non-empty effect with rows, impulses zero. `effect_of_block` receives the
/// index in `scene.effects` of each block.
Rows allocate_rows(const Scene& scene, std::vector<std::size_t>& effect_of_block);

/// Refreshes one block of rows from its effect at positions x and velocities v, and returns its share
/// sum_i r_i^T N_ii^-1 r_i of the squared dual residual (J), r = c(x)/d + Sigma p. Where N_ii is singular and
/// r is not zero, nothing can meet the constraint: its share is then r^2 weighted with `unreachable_mass`
/// (kg).
double linearise(const Effect& effect, const StepMap& map, const Points& x, const Points& v,
                 const std::vector<double>& inverse_mass, double unreachable_mass, AnyBlock& block);

/// Sum of the given forces' accelerations, m/s^2.
void accelerations(const Scene& scene, Points& acceleration);

}  // namespace pbd
