// One implicit Euler step, or a static equilibrium, as a minimum found by Newton's method.
//
//   step    minimise 1/(2 h^2) |x - y|_M^2 - f.x + U(x)  subject to c(x) = 0,   y = x_l + h v_l
//   static  minimise                      - f.x + U(x)  subject to c(x) = 0
// Newton uses the full Hessian (material and geometric stiffness, Cholesky by CHOLMOD). Where it is not
// positive definite the elements' Hessians are made so, and the note says it. Every step is accepted by a
// line search on the objective. Hard constraints enter through the augmented Lagrangian with increasing
// weight and are then solved to rounding by Newton on the KKT system (kkt.h). Nodes of infinite mass move
// with their velocity and are no unknowns. (nocedal2006numerical), ch. 3, 17, 18.
#pragma once

#include "judge.h"

namespace pbd::reference {

struct NewtonSettings {
  int max_iterations = 500;
  IterateObserver observer;
};

/// Throws SetupError for an invalid scene; everything else is in the judgement.
Judgement primal_newton(const Scene& scene, const State& state, double h, const NewtonSettings& settings);
Judgement primal_newton(const Scene& scene, const State& state, double h);

/// Equilibrium nearest downhill from the scene's initial positions: steps of growing length from rest until
/// the displacement is small, then Newton without inertia. Velocities are zero. Not converged if nothing
/// holds the scene.
Judgement primal_static(const Scene& scene, const NewtonSettings& settings = {});

}  // namespace pbd::reference
