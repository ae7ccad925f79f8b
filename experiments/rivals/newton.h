// One implicit Euler step by Newton's method on the incremental potential.
//
// H dx = -grad phi (implicit_step.h) from x_l + h v_l on, by a supernodal Cholesky factorisation, dx
// shortened by a line search. H is the true Hessian (hinges aside, see elements.h); where it is not positive
// definite, that of every element made positive semidefinite. (nocedal2006numerical, ch. 3;
// gast2015optimization)
#pragma once

#include "rivals/rival.h"

namespace pbd::rivals {

/// Throws SetupError, too, for a constraint of compliance 0, and for a scene without a node of finite mass.
std::unique_ptr<Rival> newton(const Scene& scene, double h);

}  // namespace pbd::rivals
