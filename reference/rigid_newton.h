// The step of a scene with rigid bodies by Newton's method on its equations (rigid_step.h).
//
//   [ K  -J^T ] [ (dx, d) ]   [ -load ]
//   [ J   A   ] [  gamma  ] = [ -c    ]
//
// scaled by masses and by the rows' lengths in their metric, solved by UMFPACK on independent hard rows, each
// step shortened until the scaled residual falls. Where that fails from (v_l, w_l, 0) the step's length is
// raised to h by and by, each solution the next one's start.
#pragma once

#include "primal_newton.h"

namespace pbd::reference {

/// `certified` says that the symmetric part of K is positive definite where J moves no hard constraint: the
/// system is regular there, the solution isolated. No minimum is claimed, since there is no potential.
Judgement rigid_newton(const Scene& scene, const State& state, double h, const NewtonSettings& settings);

}  // namespace pbd::reference
