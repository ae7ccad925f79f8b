// Scenes of particles, cloth and solids without contact that solvers are known to fail on.
#pragma once

#include <string>
#include <vector>

#include "scene.h"

namespace pbdcheck {

struct HardCase {
  std::string name;
  pbd::Scene scene;
  double h;              // s
  double length;         // m, the scene's size L
  double slowest = 0;    // rad/s, of the motion that dies last; infinite at rest; 0 for what never settles
  pbd::Points rest{};    // m, the shape to be recovered up to a rigid motion; empty if none
  bool tension = false;  // a hanging rope whose tension is known
};

/// Steps of h seconds after which implicit Euler has left a millionth of the energy of a vibration with
/// angular frequency `slowest` (rad/s), which it divides by 1 + (slowest h)^2 a step, and as many again; for
/// a shape to be recovered, of the amplitude. 0 at rest, -1 for what never settles.
///
/// A free body spins: implicit Euler adds h sum m v1 x v0 to the angular momentum while it vibrates, and a
/// spin w then dies slowly, w^2 = 1/(2 n h^2) at most after n steps. A cube of side L has 1/12 m L^2 w^2 of
/// energy, a millionth of m g L after n = L/(24 g 1e-6 h^2); its strain rho L^2 w^2/(8 E) is less than a
/// millionth then.
int settling_steps(const HardCase& each, double h);

/// All of them; the quick tier has smaller ones of the same kinds.
std::vector<HardCase> hard_cases(bool full);

}  // namespace pbdcheck
