// Damping of constraints (rigid_step.h): c + T dc/dt + A gamma = 0 with dc/dt = (c - c0)/d. Of implicit Euler
// d is h and c0 what c is where the step begins; by another integrator's map
//
//   c0 = c_l + along dc/dt_l + bend d2c/dt2_l + share (c_l - c_l-1)
//   dc/dt = J v,  d2c/dt2 = J a + (c(x + d v) - 2 c(x) + c(x - d v))/d^2
#pragma once

#include "rigid_step.h"

namespace pbd::reference {

/// Of each damped constraint of a scene; of the step its damping is not looked at. Throws SetupError for
/// damped point joints and attachments, whose values are then those in a body's frame.
std::map<int, Damping> damping_of(const Scene& scene, const RigidStep& undamped);

}  // namespace pbd::reference
