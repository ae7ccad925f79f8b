#include <cmath>

#include "contraction.h"
#include "dense.h"
#include "error.h"
#include "rigid_step.h"

namespace pbd::reference {
namespace {

/// Multipliers of all rows: the judge's of hard ones, -A^-1 c of compliant ones.
Vector all_multipliers(const RigidModel& model, const RigidSystem& system, const Vector& of_hard) {
  Eigen::MatrixXd compliance = system.compliance;
  Vector right = -system.value;
  for (int i = 0, next = 0; i < model.rows(); ++i)
    if (model.hard[i]) {
      compliance(i, i) = 1;
      right(i) = of_hard(next++);
    }
  return solve(compliance, right);
}

/// Increments (dx, d) by changes of the velocities.
Eigen::MatrixXd increments(const RigidStep& step, const Vector& velocity) {
  const auto n = velocity.size();
  Eigen::MatrixXd inverse(n, n);
  for (Eigen::Index i = 0; i < n; ++i) inverse.col(i) = velocity_change(step, velocity, Vector::Unit(n, i));
  return reference::inverse(inverse);
}

}  // namespace

Contraction plain_contraction_of_bodies(const Scene& scene, const State& start, double h,
                                        const Judgement& solved) {
  const RigidStep step{make_rigid_model(scene), start, h};
  if (step.model.gyroscopic == GyroscopicTorque::at_end)
    throw SetupError("plain_contraction_of_bodies", "an implicit gyroscopic torque",
                     "a scene without one, or with an explicit one");
  RigidStep at_end = step;
  at_end.start.v = solved.v;
  at_end.start.spin = solved.spin;
  const Vector velocity = at_end.start_velocity();
  const RigidSystem without = system_at(step, velocity, Vector::Zero(step.model.rows()));
  const RigidSystem system =
      system_at(step, velocity, all_multipliers(step.model, without, solved.multiplier));

  const Eigen::MatrixXd turn = increments(step, velocity), jacobian = system.jacobian;
  const Eigen::MatrixXd inertia = Vector(step.model.inertia / h).asDiagonal();
  const auto n = inertia.rows(), rows = jacobian.rows();
  Eigen::MatrixXd left(n + rows, n + rows), right(n + rows, n);
  left << inertia, -jacobian.transpose(), h * jacobian, Eigen::MatrixXd(system.compliance);
  right << inertia - Eigen::MatrixXd(system.tangent) * turn, h * jacobian - jacobian * turn;
  const Eigen::MatrixXd map = solve(left, right).topRows(n);
  return extremes(map);
}

}  // namespace pbd::reference
