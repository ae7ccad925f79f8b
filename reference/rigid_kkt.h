// The linear system of a Newton step on the equations of rigid_step.h, scaled by masses and by the rows'
// lengths in their metric.
#pragma once

#include "rigid_step.h"

namespace pbd::reference {

/// Scales that make the inertia of an increment and the effective mass of a row one.
struct Scales {
  Vector unknown;  // inertia^-1/2
  Vector row;      // (J M^-1 J^T + A/h^2)_ii^-1/2, zero of rows that are left out
};
Scales scales_of(const RigidStep& step, const RigidSystem& system);

/// Sets the scale of hard rows to zero that depend on others but for `threshold`, and returns how many do
/// not.
int drop_dependent(const RigidModel& model, const RigidSystem& system, double threshold, Scales& scales);

/// [K -J^T; J A], factorised.
class RigidKkt {
 public:
  /// False where it is singular.
  bool compute(const RigidStep& step, const RigidSystem& system, const Scales& scales);

  /// Increments (dx, d) and multipliers, zero of dropped rows, for right sides in N (N m) and of the rows.
  void solve(const Vector& force, const Vector& value, Vector& increment, Vector& gamma) const;

 private:
  Scales scales_;
  double h2_ = 0;        // s^2
  SparseMatrix matrix_;  // that the factor goes on to read
  SparseLu lu_;
};

}  // namespace pbd::reference
