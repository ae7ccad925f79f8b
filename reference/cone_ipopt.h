// The second judge of contact with friction: Ipopt on two smooth forms of the cone.
//
//   polar   r = p (1, mu s),      p >= 0,    |s|^2 <= 1                  not convex, smooth at the apex
//   ratio   r_N >= 0,             mu r_N - |r_T|^2 / (mu r_N) >= 0       convex, with a pole at the apex
// The ratio is tried where the polar form misses the tolerance, then both with Ipopt's adaptive barrier.
// Neither is regular where r = 0, so Ipopt's own status says little: what counts is the natural residual.
// Independent of the first judge by formulation, derivatives, path and linear solver (MUMPS); only the
// contacts' equilibration is shared.
#pragma once

#include "cone_problem.h"

namespace pbd::reference {

inline constexpr int most_ipopt_contacts = 300;  // its Hessian is dense

/// Certified by the natural residual. Not converged, with a reason, for more contacts than that. Work is
/// taken after each run of Ipopt.
ConeSolution cone_ipopt(const ConeProblem& problem, FrictionLaw law, double tolerance,
                        ConeWork* work = nullptr);

}  // namespace pbd::reference
