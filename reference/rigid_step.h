// The implicit Euler step of a scene with rigid bodies as a square system of equations, which no potential
// has: the torque is that at the step's end. Unknowns are end velocities v, w (w in the body's frame) and
// multipliers gamma; end pose x = x_l + h v, R = R_l exp(h [w]x).
//
//   M (v - v_l)/h = f + J_x^T gamma
//   I (w - w_l)/h = R_l^T tau + J_d^T gamma - w x I w      (the last one of w_l if explicit, absent if none)
//   c(x, R, t_l + h) + A gamma = 0
//
// with d the turn of the body as it stands at the end. Its derivatives are by increments (dx, d), with
// d = h J_r(h w) dw.
#pragma once

#include <map>
#include <optional>

#include "judge.h"
#include "rigid_rows.h"

namespace pbd::reference {

/// Damping of a constraint, c1 + T (c1 - c0)/d + A gamma = 0, as c1 - offset + share A gamma = 0 with the
/// share (1 + T/d)^-1 and the offset (1 - share) c0.
struct Damping {
  RowMatrix share;
  RowVector offset;
};

/// What an integrator makes of a step in the place of implicit Euler (integrator_map.h): velocities v end at
///   x = x_l + shift + d v  (of rotations the arc shift + d w),   M (v - base)/s = f + J^T gamma
/// and of the rate of a damped constraint (damping.h), whose value goes by the same rule as positions:
///   c = c_l + along dc/dt_l + bend d2c/dt2_l + share (c_l - c_l-1) + d dc/dt
struct IntegratorMap {
  double d = 0, s = 0;              // s
  Vector shift;                     // per unknown, m or rad
  Vector base;                      // per unknown, m/s or rad/s
  double along = 0, bend = 0;       // s, s^2
  Vector acceleration{};            // per unknown, m/s^2 or rad/s^2, where the step begins: if bend is not 0
  double share = 0;                 // 1
  std::optional<Placement> last{};  // where the step before began: if share is not 0
  double extension = 1;             // how many times as far as solved for the step goes on in the end
};

struct RigidStep {
  RigidModel model;
  State start;
  double h;
  std::map<int, Damping> damping{};    // by a constraint's first row
  std::optional<IntegratorMap> map{};  // none: implicit Euler

  double d() const { return map ? map->d : h; }
  double extension() const { return map ? map->extension : 1; }
  double s() const { return map ? map->s : h; }
  /// Where the unknowns go by themselves, and the velocities that forces change.
  Vector shift() const { return map ? map->shift : Vector::Zero(model.unknowns); }
  Vector base() const { return map ? map->base : start_velocity(); }
  /// The way of a body's rotation, rad in its own axes.
  Vec3 arc(const Vector& velocity, int unknown) const {
    const Vec3 turned = d() * velocity.segment<3>(unknown);
    return map ? Vec3(map->shift.segment<3>(unknown) + turned) : turned;
  }

  /// Velocities of the unknowns.
  Vector start_velocity() const;
  Placement placement(const Vector& velocity) const;
  State end(const Vector& velocity) const;
  /// Where the step ends that is solved by `velocity`, beyond its `end` by the map's extension.
  State carried_on(const Vector& velocity) const;
};

/// The system at (velocity, gamma).
struct RigidSystem {
  /// M (v - v_l)/h - f and likewise of rotations (N, N m): what J^T gamma has to balance; and the sum of its
  /// absolute contributions and those of J^T gamma.
  Vector load, magnitude;
  SparseMatrix tangent;   // of load - J^T gamma by (dx, d)
  SparseMatrix jacobian;  // of all rows by (dx, d)
  SparseMatrix compliance;
  Vector value;  // c, all rows

  /// load - J^T gamma and c + A gamma: zero at the end of the step.
  Vector force(const Vector& gamma) const;
  Vector gap(const Vector& gamma) const;
};
RigidSystem system_at(const RigidStep& step, const Vector& velocity, const Vector& gamma);

/// J_r(t)^-1 with exp(t + dt) = exp(t) exp(J_r(t) dt): 1 + [t]/2 + (1 - |t|/2 cot(|t|/2)) / |t|^2 [t]^2.
Eigen::Matrix3d inverse_right_jacobian(const Vec3& t);

/// Change of the velocities by increments (dx, d).
Vector velocity_change(const RigidStep& step, const Vector& velocity, const Vector& increment);

/// State, hard rows' multipliers, residual and infeasibility of a judgement. `displacement` (m) is that of
/// the nodes and, times their radii of gyration, of the rotations.
double displacement_of(const RigidStep& step, const Vector& velocity);
void report(const RigidStep& step, const Vector& velocity, const Vector& gamma, Judgement& judgement);

/// The rows of a matrix or vector that belong to hard constraints.
SparseMatrix hard_rows(const RigidModel& model, const SparseMatrix& rows);

}  // namespace pbd::reference
