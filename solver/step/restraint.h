// What a missed step hands on gains no energy beyond what forces bring. Of each component (columns that rows
// connect), velocities u beside a motion of its own, accelerations f by given forces, the step's gain is
//   |u|_M^2/2 - |u_l|_M^2/2 - f.M (x - x_l) + Psi(x) - Psi(x_l),
// Psi the elastic energy, and of each hard constraint and contact that misses r the energy that meeting it
// alone takes, r^T N_ii^-1 r/2. A solution that begins with all constraints met gains nothing: impulses act
// against motion. One that begins with hard constraints missed gains what meeting them takes against their
// impulses p, -p.r: a sunken stack is lifted. Where the gain is above what the component may take back, u is
// multiplied by the largest t < 1 that makes it that, Psi taken as linear in t. It may take back what the
// missed steps before have lost beside what forces bring, up to the sum of -p.r where the step begins: so
// what missed steps leave open is energy that they have spent. A component's own motion is that of its centre
// of mass; where it is held from outside, the slowest of what holds it.
//
// Under continuous contact the way of a component that would pass something is shortened to where they are
// apart: its velocity with it, as a step of what it goes would have it.
//
// Limits: what holds a component is taken not to turn. The angular momentum of what nothing holds is lost
// with u; scaled impulses would keep it, and let joints and overlaps go. With warm_start off nothing is taken
// back: what has sunk stays until a step is solved.
#pragma once

#include "outer/components.h"
#include "outer/step_system.h"

namespace pbd {

class Restraint {
 public:
  /// Slows the iterate's v if it gains energy, and returns whether it did: rows and x are to be refreshed
  /// then. Linearises the rows at v. `given` are the accelerations by given forces (m/s^2).
  bool restrain(StepSystem& system, const Points& given);

  /// Shortens the way of each component that `restrain` found to the least of its columns' shares; false if
  /// what these ask for stands already.
  bool shorten(StepSystem& system, const std::vector<double>& share) const;

  /// Keeps for the next step what has been lost where rows, refreshed at the restrained iterate, are open.
  void keep_lost(const StepSystem& system);

  /// The next step does not follow a missed one.
  void forget() { lost_.clear(); }

 private:
  struct Motion {                             // of a component
    Vec3 own, own_start;                      // m/s, its own motion, and where the step begins
    double mass = 0;                          // kg, where it is not held
    double slowest = infinity;                // m/s, of what holds it
    double gained = 0, linear = 0, most = 0;  // J: the gain is t^2 gained + t linear - most
    double lost = 0, open = 0;                // J: by missed steps since the last solved one; sum of -p.r
    double share() const;
  };

  void find_motions(const StepSystem& system);
  void add_stored(const StepSystem& system, const Points& v, double sign);
  void find_open(const StepSystem& system, const Points& v);
  void add_kinetic(const StepSystem& system, const Points& given);

  Components components_;
  std::vector<Motion> motions_;
  std::vector<double> open_, lost_;  // J, of each column; what it loses is empty after a solved step
  Points rest_;                      // m/s, zero
};

}  // namespace pbd
