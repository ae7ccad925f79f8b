// Conjugate gradients with a preconditioner (hestenes1952methods) on a system that offers
//   double precondition()      z = B r of the residual r; returns r . z
//   bool solved(product)       true to end
//   void turn(beta)            direction s = beta s + z
//   double apply()             A s; returns s . A s
//   void advance(length)       moves along s, and r with it
#pragma once

namespace pbd {

/// Returns the number of iterations, `most` at most; ends, too, where A is not definite along s.
template <class System>
int preconditioned_cg(System&& system, int most) {
  double last = 0;
  for (int k = 0; k < most; ++k) {
    const double product = system.precondition();
    if (system.solved(product)) return k;
    system.turn(k > 0 ? product / last : 0.0);
    const double curvature = system.apply();
    if (!(curvature > 0)) return k + 1;
    system.advance(product / curvature);
    last = product;
  }
  return most;
}

}  // namespace pbd
