// Whether a step of implicit_euler gains energy beyond what forces bring. With impulses p = M (v1 - v0) of
// whatever acts, |v1|_M^2/2 - |v0|_M^2/2 = v1.p - |p|^2_W/2, W the inverse masses. So of kinetic and elastic
// energy less the work h f.v1 of given forces at most this may be gained:
//   hard constraints, limits and bounded motors   the work of their forces, where it is positive
//   compliant ones, c^T A^-1 c/2 = Psi            Psi1 - Psi0 - A^-1 c1 . h J v1, what their curvature and
//                                                 their motors bring, and what a solved step may miss of
//                                                 their forces: level sqrt(y^T N y), N the matrix by which
//                                                 that is measured, y = A^-1 h J v1; not of damped ones
//   damping, the rest q of the force told         nothing but for the curvature of c:  |q| |c1 - c0 - h J v1|
//                                                 of a force that is told in a body's axes what its size
//                                                 allows
//   contacts                                      F_n times the gap told and the depth at which they begin:
//                                                 support functions show it along the normal; friction and
//                                                 collisions bring nothing; bodies that are led and surfaces
//                                                 that move along themselves, their work
// A point that turns by h w at the lever r leaves its tangent by at most |h w|^2 r/2.
//
// A collision's normal velocity ends as -e of that at the step's start, e <= 1, so that F_n acts along the
// mean of both, which does not part the shapes: v1.p - |p|^2_W/2 = p.(v0 + v1)/2. The step's other impulses q
// may then give back the -q.(v1 - v0)/2 that a collision makes of them: gravity h g v1 is the first order of
// rebounds. So may contacts that do not close where the step begins: a small body that leaves the ground, and
// is pressed on it by a large one that it meets, throws that off by e of its own speed. Newton's law with
// friction may gain what friction does where it turns a slip round; the convex law, whose normal velocity
// gives back what friction takes along the end's slip, all that it does along the slip at the start.
//
// Limits: not of steps in which deformable surfaces are pressed (`left_out`), nor of other integrators.
#pragma once

#include "step_equations.h"

namespace pbd::reference {

/// `level` in sqrt(J).
void check_energy(const StepClaim& claim, const StepModel& model, double level, Findings& findings);

}  // namespace pbd::reference
