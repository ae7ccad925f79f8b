// From the integrator's coefficients to the affine map of a step, from the solved map to the step's end, and
// what an integrator keeps of earlier steps.
#pragma once

#include "outer/step_system.h"
#include "step/integrators.h"

namespace pbd {

class History {
 public:
  explicit History(const Integrator& integrator) : integrator_(&integrator) {}

  /// Sets the problem's map of a step of h seconds from `state`, then lets each source begin the step:
  /// damping sets its offsets, contacts are found.
  void begin_step(double h, const State& state, StepSystem& system);

  /// True if something strikes in the step begun of which that was not known: the step has begun again, by
  /// the map of implicit Euler.
  bool begin_again_if_struck(StepSystem& system);

  /// Lets sources find rows anew that the iterate calls for, which is solved to a tolerance of the scale.
  Widened widen(StepSystem& system, double tolerance) const;

  /// Lowers the share of its way to the iterate that each column may go, so that nothing passes what it
  /// begins apart from where ways are looked at; true if any is lower.
  bool hold_back(StepSystem& system, std::vector<double>& share) const;

  /// Carries the map on to the step's end; it may have been missed.
  void end_step(double h, const StepSystem& system, bool missed, State& state);

  /// The step diverged and leaves `state` as it was: the next one is a start, and from there one after a
  /// miss.
  void diverge(const StepSystem& system, const State& state);

  /// True if the step begun goes on from the end of one that missed.
  bool after_miss() const { return continued_ && missed_; }

  /// The next step is a start: what a script leads jumps, or no force tells how the last one ended.
  void begin_anew() { h_ = 0; }

  /// m/s^2, of the last step begun.
  const Points& given_accelerations() const { return acceleration_; }

  const Integrator& integrator() const { return *integrator_; }

 private:
  bool goes_on(const StepSystem& system, const State& state) const;
  bool is_where_it_ended(const State& state) const;
  void keep_end(const StepSystem& system, const State& state);
  void find_pressed(const StepSystem& system);
  void carry_on(double h, bool goes_on, StepSystem& system);
  void set_map(double h, bool goes_on, bool anew, StepSystem& system);
  bool strikes(const StepSystem& system) const;
  bool begin_sources(bool anew, StepSystem& system);
  StepBegin step_begin(const Problem& problem, const Configuration& start, const Configuration& ahead,
                       const Configuration& behind) const;

  const Integrator* integrator_;
  double h_ = 0;               // s, of the last step; 0 if there is none
  int gone_on_ = 0;            // steps before the one begun, from a start on
  bool missed_ = false;        // the last step
  bool continued_ = false;     // from where it ended
  bool struck_ = false;        // something, in the step begun
  Points x_, v_;               // where the last step began
  Points q_, a_;               // m/s^2, as in integrators.h; a_ has a meaning where a_v > 0
  Points acceleration_;        // m/s^2, by given forces
  Points pressed_;             // m/s, what impulses of contacts brought in the last step; empty without any
  Points ahead_x_, behind_x_;  // m, d further and back along v, where an effect is damped
  std::vector<Pose> ahead_poses_, behind_poses_;
  Points end_x_, end_v_;
  State ended_;  // where the last step ended, kept where there are rigid bodies or contacts
};

}  // namespace pbd
