// What the judge says about the end of a step that somebody else found: how far is it from the equations?
//
//   primal  g = M (v - v_free) - J(x)^T p,        |g| in the metric of inverse masses
//   dual    r_i = c_i(x)/h + A_i/h^2 p_i,         sqrt(sum_i r_i^T N_ii^-1 r_i),  N_ii = J_i W J_i^T +
//   A_i/h^2
//
// with the effects' values and derivatives in the judge's own words, and the impulses p that make |g|^2 +
// |r|^2 smallest (sparse QR). Whoever found impulses with two small residuals has an end where this one is
// small.
#pragma once

#include "scene.h"

namespace pbd::reference {

/// All in sqrt(J).
struct StepResidual {
  double residual = 0;  // sqrt(|g|^2 + |r|^2), the least over all impulses
  double scale = 0;     // |v - v_l|_M + |v_free - v_l|_M
  double rounding = 0;  // of x and v at the end, as the residual sees it
  double own = 0;       // of the judge's own computation
};

/// Of the implicit Euler step of h seconds from `start` to `end`. Throws SetupError for an invalid scene.
StepResidual residual_of(const Scene& scene, const State& start, double h, const State& end);

}  // namespace pbd::reference
