// The first judge of contact with friction: interior point, then semismooth Newton.
//
//   min 1/2 r.W r + q.r over |r_T| <= mu r_N   by   x = (mu r_N, r_T), z = (u_N / mu, u_T) in Lorentz cones
// Scaling Theta (Theta x = Theta^-1 z) (nesterov1997selfscaled), predictor and corrector
// (mehrotra1992implementation); each Newton step is (N + Theta^2) dx = rhs, solved by a sparse Cholesky
// factorisation. A bounded row is a half line, or two of them between its bounds. Contacts are equilibrated
// by one positive number each; one with mu = 0 has a half line (vandenberghe2010cvxopt). Coulomb's law is
// solved as a sequence of such problems (cone_fixed_point.h).
#pragma once

#include "cone_problem.h"

namespace pbd::reference {

/// The minimum within about the square root of its gap: impulses and number of iterations. No polish.
ConeSolution interior_point(const ConeProblem& problem, ConeWork* work = nullptr);

/// Interior point and polish, certified by the natural residual. `tolerance` bounds that residual.
ConeSolution cone_interior_point(const ConeProblem& problem, FrictionLaw law, double tolerance,
                                 ConeWork* work = nullptr);

}  // namespace pbd::reference
