// One implicit Euler step as a nonlinear program, solved by Ipopt with exact Hessian.
//
//   minimise 1/(2 h^2) |x - y|_M^2 - f.x + U(x)  subject to c(x) = 0,   y = x_l + h v_l
// Own scaling, so that masses and lengths do not matter: unknowns z = sqrt(M/m) (x - x_l)/d with m the mean
// mass and d the displacement of the free step; objective in units of m d^2/h^2; each row of J of unit length
// at the start. Independent of primal_newton in its path: interior point code with MUMPS, inertia correction
// and filter line search (waechter2006implementation); shared with it are the energies and their derivatives.
#pragma once

#include "judge.h"

namespace pbd::reference {

/// Throws SetupError for an invalid scene; Ipopt's own failure is in the outcome and the reason. `certified`
/// stays false: Ipopt checks inertia only on the way.
Judgement ipopt(const Scene& scene, const State& state, double h);

}  // namespace pbd::reference
