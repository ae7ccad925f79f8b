// The equations of a step of rigid bodies with the end quaternions as unknowns (rigid_nonlinear.h), and their
// Jacobian.
#pragma once

#include "rigid_step.h"

namespace pbd::reference {

/// Where unknowns and equations stand: velocities, quaternions of turning bodies, multipliers.
struct Layout {
  const RigidModel& model;
  std::vector<int> quaternion;  // of each rotor, or -1
  int multipliers = 0, size = 0;

  explicit Layout(const RigidModel& m);
};

/// Residuals and Jacobian of the equations at z: entries at the same place add up.
struct Equations {
  Vector residual;
  Triplets jacobian;
};

Equations equations_at(const RigidStep& step, const Layout& layout, const Vector& z);

}  // namespace pbd::reference
