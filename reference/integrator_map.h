// What integrators other than implicit Euler make of a step (rigid_step.h), from their formulas and the steps
// before. Of BDF2, with w = h/h_l-1, y = (x, v) and y' of the motion between contacts,
//
//   y_l+1 = y_l + w^2/(1 + 2 w) (y_l - y_l-1) + h (1 + w)/(1 + 2 w) y'_l+1
//
// so that x = x_l + shift + d v and M (v - base)/d = f + J^T gamma, with
//
//   d = h (1 + w)/(1 + 2 w),  shift = w^2/(1 + 2 w) (x_l - x_l-1),
//   base = v_l + w^2/(1 + 2 w) (v_l - v_l-1 - b), b what contacts brought as the last step ended
//
// Of generalised alpha (chung1993time), with a for accelerations and q for those by all forces but contacts'
// impulses,
//
//   x_l+1 = x_l + h v_l + h^2 ((1/2 - beta) a_l + beta a_l+1)
//   v_l+1 = v_l + h ((1 - gamma) a_l + gamma a_l+1)
//   (1 - alpha_m) a_l+1 + alpha_m a_l = (1 - alpha_f) q_l+1 + alpha_f q_l
//
// solved for v_l+1; Newmark's own family has alpha_m = alpha_f = 0. By alpha his rule is
//
//   x_l+1 = x_l + h ((1 - alpha) v_l + alpha v_l+1),  v_l+1 = v_l + h ((1 - alpha) q_l + alpha q_l+1)
//
// The midpoint rule is implicit Euler's step of h/2, carried on as far again; of a damped value's rate there
//
//   dc/dt = (c - c_l)/d + d/2 v_l^T c'' v_l,  d = h/2
//
// Contacts' impulses end in v_l+1, not in a_l+1 and q_l+1; but the next x has h a_l with what they brought,
// so that what rests stays at rest. Of a rotation x is the arc that it has turned by, in the body's own axes.
// Impulses of contacts act over h. A step that is the first one, or does not begin where the last one ended,
// knows q and a by the compliant constraints' values. BDF2 and generalised alpha in contact begin with a step
// of implicit Euler, and where a constraint is hard all but the midpoint rule with three. So are steps in
// which things strike, by contact or a force of one sign, or a motor jumps. Whether that is so the solver
// decides; here it is read from the step's own places, which only one of the maps leads to: that of a motion
// that goes on, that of a start, and implicit Euler's.
#pragma once

#include <string_view>

#include "method.h"
#include "rigid_step.h"
#include "step_claim.h"

namespace pbd::reference {

/// Throws SetupError, which says `where`, for an integrator whose steps the judges do not state.
void require_judged(std::string_view integrator, const std::string& where);

/// Follows a motion step by step.
class IntegratorMemory {
 public:
  /// Of the method its integrator and what that one's parameters are. Throws SetupError for integrators that
  /// are not judged.
  explicit IntegratorMemory(const Method& method = {});

  /// The map that leads to a claim's end; none for implicit Euler's.
  std::optional<IntegratorMap> map_of(const StepClaim& claim) const;

  /// The map of the step of h seconds from `start`, if nothing strikes in it; none for implicit Euler's.
  std::optional<IntegratorMap> smooth_map(const Scene& scene, const State& start, double h) const;

  /// Takes what the next step needs to know of this one.
  void follow(const StepClaim& claim);

 private:
  /// Where a step begins: accelerations q by all forces and the a carried on, and the speed that contacts
  /// brought over the time in which they did; m/s^2 and rad/s^2.
  struct Begun {
    Vector q, a, pushed;
  };

  bool goes_on(const State& start) const;
  bool carries_nothing() const {
    return method_.integrator == "implicit_euler" || method_.integrator == "midpoint";
  }
  bool carries_accelerations() const { return !carries_nothing() && method_.integrator != "bdf2"; }
  Begun begun(const Scene& scene, const RigidStep& step, bool goes_on) const;
  std::optional<IntegratorMap> map_from(const Scene& scene, const State& start, double h, bool goes_on) const;
  /// `map`, or what else leads nearer to the claim's end.
  std::optional<IntegratorMap> nearest_map(const StepClaim& claim, std::optional<IntegratorMap> map) const;
  IntegratorMap bdf2(const RigidStep& step) const;
  IntegratorMap newmark(const RigidStep& step, const Begun& begun) const;
  IntegratorMap by_accelerations(const RigidStep& step, const Begun& begun) const;
  void follow_acceleration(const RigidStep& step, const Vector& velocity);

  Method method_;
  double h_ = 0;                 // of the last step, s; 0: none
  int followed_ = 0;             // steps from a start on
  bool struck_ = false;          // something in the last step
  Vector before_;                // velocities where it began
  Placement last_;               // and places
  Vector moved_;                 // its ways and arcs, m and rad
  Vector acceleration_, begun_;  // a at its end and its begin, m/s^2 and rad/s^2
  Vector by_constraints_;        // the part of q by constraints and gyroscopic torques at the end
  Vector pressed_;               // what contacts brought, m/s and rad/s
  std::optional<State> ended_;
};

}  // namespace pbd::reference
