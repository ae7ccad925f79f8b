// Steps of bodies in contact with friction solved together with the normal impulses, and with friction at the
// end of the step, as engines of position based dynamics do it: normal impulses without friction move the
// bodies; then the slip of each contact is braked once, one after the other, by at most mu times its normal
// impulse, which changes velocities alone. The positions keep what the step slid:
//   what friction holds, and never turns, creeps at h a, a the acceleration that the missing friction would
//   balance; what turns creeps faster.
#pragma once

#include "scene.h"

namespace pbdcheck {

enum class FrictionPlace { within, end };  // the step

/// What a step was, beside its end.
struct PlacedFriction {
  double residual = 0;     // natural residual of Coulomb's law by the step's impulses, |map| / |q|
  double penetration = 0;  // m, deepest overlap at the end of its positions, as linearised
  int sweeps = 0;          // that its contacts took, by `direct`
  bool solved = false;     // its contacts, with friction or without, to 1e-12
};

/// An implicit Euler step of h seconds, linearised where it begins. Throws Interrupted.
PlacedFriction step_with(FrictionPlace place, const pbd::Scene& scene, double h, pbd::State& state);

}  // namespace pbdcheck
