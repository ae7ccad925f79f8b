// The linear rows of a step, linearised once where the step begins, and their exact solution by a dense
// factorisation.
#pragma once

#include "rows.h"
#include "scene.h"

namespace pbdcheck {

struct LinearStep {
  pbd::Rows rows;      // impulses zero
  pbd::Points v_free;  // m/s
};

/// Adds smooth velocities that excite every mode.
void stir(pbd::Scene& scene);

/// Implicit Euler rows of h seconds from `state`, linearised at its positions; those of contacts by `law`.
LinearStep linear_step(const pbd::Scene& scene, const pbd::State& state, double h,
                       pbd::Friction law = pbd::Friction::coulomb);

/// Velocities (m/s) that solve the rows exactly, by Eigen's dense LDL^T of N = J W J^T + Sigma.
pbd::Points dense_solution(const LinearStep& step);

/// sqrt(sum_i r_i^T N_ii^-1 r_i) of r = J v + b + Sigma p at the rows' impulses, sqrt(J).
double residual(const pbd::Rows& rows, const pbd::Points& v);

}  // namespace pbdcheck
