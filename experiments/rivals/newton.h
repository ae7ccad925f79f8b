// One implicit Euler step by Newton's method on the incremental potential.
//
//   phi(x) = 1/(2 h^2) |x - y|_M^2 + U(x),   y = x_l + h v_l + h^2 a,   v = (x - x_l)/h
//
// a is the acceleration by gravity and external forces. H dx = -grad phi by a supernodal Cholesky
// factorisation, dx shortened by a line search. With p = -h A^-1 c the residual |v - v_free - W J^T p|_M is h
// |grad phi|_{M^-1}. H is the true Hessian (hinges aside, see elements.h); where it is not
// positive definite, that of every element made positive semidefinite. Nodes of infinite mass move with their
// velocity and are no unknowns. (nocedal2006numerical, ch. 3;
// gast2015optimization)
#pragma once

#include "rivals/rival.h"

namespace pbd::rivals {

/// Throws SetupError, too, for a constraint of compliance 0, and for a scene without a node of finite mass.
std::unique_ptr<Rival> newton(const Scene& scene, double h);

}  // namespace pbd::rivals
