// Semismooth Newton on the natural map, from near a solution to rounding.
//
//   F(r) = r - P_K(r - u~(r)),   [I - D + D (G W + e I)] d = -F,   G_i = I + mu e_N (u_T/|u_T|)^T for coulomb
// D is an element of the projection's generalised derivative. W may be singular: e > 0 makes the matrix
// regular, and refinement takes e out of the step again, which stays in the range of W: least norm. Steps are
// halved until |F| falls; e grows where they do not (Levenberg, Marquardt) and falls with success. Solutions
// do not change if u~ is weighed; F does: contacts are equilibrated, and u~ counts sqrt(|r| / |u|) of the
// start, so that neither is lost beside the other. (qi1993nonsmooth), (li2018highly).
#pragma once

#include "cone_problem.h"

namespace pbd::reference {

/// Improves `impulse` until |F| / |q| is at most `target` or what rounding makes of it, no step helps or the
/// work is spent; returns the number of steps. What comes out is never worse than what went in.
int cone_newton(const ConeProblem& problem, FrictionLaw law, double target, Eigen::VectorXd& impulse,
                ConeWork* work = nullptr);

}  // namespace pbd::reference
