// The step of a scene with rigid bodies as a feasibility problem for Ipopt: objective zero, one equation for
// each unknown.
//
// Unknowns are v of the nodes, w and the end quaternion q of the bodies, and gamma; R is a polynomial in q,
// so that no derivative is shared with rigid_newton:
//
//   M (v - v_l)/h - f = J_x^T gamma,   q = q_l (cos(h |w|/2), h w/2 sinc(h |w|/2))
//   I (w - w_l)/h + ... = Im(q* sum_k gamma_k dc_k/dq)/2
//   c + A gamma = 0
//
// the work of a turn d of the body being dc/dq . q (0, d/2). Shared with it are the values of the
// constraints.
#pragma once

#include "judge.h"

namespace pbd::reference {

Judgement rigid_ipopt(const Scene& scene, const State& state, double h);

}  // namespace pbd::reference
