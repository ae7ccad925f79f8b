// What a missed step hands on gains no energy beyond what forces bring. Of each component (columns that rows
// connect), velocities u beside a motion of its own, accelerations f by given forces, the step's gain is
//   |u|_M^2/2 - |u_l|_M^2/2 - f.M (x - x_l) + Psi(x) - Psi(x_l),
// Psi the elastic energy, and of each hard constraint and contact that misses r the energy that meeting it
// alone takes, r^T N_ii^-1 r/2. A solution that begins with all constraints met gains nothing: impulses act
// against motion. Where the gain is above 0, u is multiplied by the largest t < 1 that makes it 0, Psi taken
// as linear in t. So what missed steps leave open is energy that they have spent. A component's own motion is
// that of its centre of mass; where it is held from outside, the slowest of what holds it.
//
// Limits: what holds a component is taken not to turn. The angular momentum of what nothing holds is lost
// with u; scaled impulses would keep it, and let joints and overlaps go.
#pragma once

#include "outer/components.h"
#include "outer/step_system.h"

namespace pbd {

class Restraint {
 public:
  /// Slows the iterate's v if it gains energy; rows and x are to be refreshed then. `given` are the
  /// accelerations by given forces (m/s^2).
  void restrain(StepSystem& system, const Points& given);

 private:
  struct Motion {                             // of a component
    Vec3 own, own_start;                      // m/s, its own motion, and where the step begins
    double mass = 0;                          // kg, where it is not held
    double slowest = infinity;                // m/s, of what holds it
    double gained = 0, linear = 0, most = 0;  // J: the gain is t^2 gained + t linear - most
    double share() const;
  };

  void find_motions(const StepSystem& system);
  void add_stored(const StepSystem& system, const Points& v, double sign);
  void add_kinetic(const StepSystem& system, const Points& given);

  Components components_;
  std::vector<Motion> motions_;
  Points rest_;  // m/s, zero
};

}  // namespace pbd
