// Damping of constraints in a step of implicit Euler (rigid_step.h).
#pragma once

#include "rigid_step.h"

namespace pbd::reference {

/// Of each damped constraint of a scene. `undamped` is the model without. Throws SetupError for damped point
/// joints and attachments, whose values are then those in a body's frame.
std::map<int, Damping> damping_of(const Scene& scene, const RigidModel& undamped, const Placement& start,
                                  double h);

}  // namespace pbd::reference
