// proximal: as plain, with M + D for M and (M + D)^-1 (M v_free + D v_k) for v_free; accelerated. It has
// plain's fixed points and multiplies an error by (D - K)/(M + D + material stiffness), which is below 1
// where D >= K/2 and the step's potential is convex on the motions that hard rows allow. D is half the
// effects' own bounds of the stiffening part of K, one number a column, zero where no impulse pulls.
// Unconverged, D takes momentum from one node to another: a step restores the linear momentum of every
// component that nothing outside holds, not the angular one; in scenes with contact of none.
#pragma once

#include "outer/acceleration.h"
#include "outer/free_components.h"
#include "outer/geometric_mass.h"

namespace pbd {

class Proximal {
 public:
  static constexpr bool solves_step = true;

  explicit Proximal(const StepSystem& system)
      : acceleration_(system.problem.method.memory), components_(system) {}

  void begin(StepSystem&) {
    acceleration_.forget();
    heavier_ = false;
  }
  void iterate(StepSystem& system, Progress& progress);
  void forget() { acceleration_.forget(); }
  void end(StepSystem& system) {
    if (heavier_) components_.restore_momentum(system);
  }

 private:
  void add_mass(StepSystem& system);

  GeometricMass mass_;
  Acceleration acceleration_;
  FreeComponents components_;
  bool heavier_ = false;  // D was added in this step
};

}  // namespace pbd
