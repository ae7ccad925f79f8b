#include "step/history.h"

#include <algorithm>

#include "effects/sources.h"

namespace pbd {

/// Whoever has changed the state since the last step begins anew.
bool History::goes_on(const StepSystem& system, const State& state) const {
  if (!(h_ > 0)) return false;
  if (system.problem.bodies.count() == 0) return state.x == system.at.x && state.v == system.at.v;
  return continued_;
}

bool History::is_where_it_ended(const State& state) const {
  if (ended_.x.cols() != state.x.cols()) return false;
  const auto same = [](const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
    return a.coeffs() == b.coeffs();
  };
  return state.x == ended_.x && state.v == ended_.v && state.spin == ended_.spin &&
         std::equal(state.orientation.begin(), state.orientation.end(), ended_.orientation.begin(), same);
}

/// What impulses of contacts have brought as the step ends.
void History::find_pressed(const StepSystem& system) {
  if (!system.rows.contacts || integrator_->keeps == Keeps::nothing) return;
  pressed_.setZero(3, system.problem.bodies.columns());
  for (const Slot& slot : system.slots)
    if (slot.source->kind().contacts)
      apply_impulses(slot.view(system.rows), system.problem.inverse_mass, pressed_);
}

/// True if velocities jump in the step by more than what the integrator carries on allows.
bool History::strikes(const StepSystem& system) const {
  if (!integrator_->begins_anew) return false;
  const bool rebounds = integrator_->rebounds && !system.problem.hard_constraints;
  return std::any_of(system.slots.begin(), system.slots.end(), [&](const Slot& slot) {
    const Impact impact = slot.source->impact(slot.view(system.rows), system.at.v);
    return impact >= (rebounds ? Impact::stop : Impact::rebound);
  });
}

/// q_l and a_l of the step that begins.
void History::carry_on(double h, bool goes_on, StepSystem& system) {
  const Problem& problem = system.problem;
  const StepCoefficients& c = problem.coefficients;
  q_ = acceleration_;
  if (!goes_on) {
    for (const Slot& slot : system.slots)
      slot.source->add_compliant_forces(problem.start(), problem.start_v, problem.inverse_mass, q_);
    const Bodies& bodies = problem.bodies;
    for (int b = 0; b < bodies.count() && problem.implicit_gyroscopic; ++b)
      q_.col(bodies.column(b)) += bodies.gyroscopic(b, problem.start_v.col(bodies.column(b)));
    a_ = q_;
    return;
  }
  q_ += (system.at.v - problem.map.v_free) / problem.map.s;
  if (c.a_v > 0) a_ = (system.at.v - v_ - c.a_a * a_) / c.a_v;
  if (pressed_.cols() > 0) {
    q_ -= pressed_ / problem.map.s;
    if (c.a_v > 0) a_ -= pressed_ / c.a_v;
  }
  // a_l is the acceleration at an instant apart from t_l, in proportion to the step.
  if (h != h_) a_ = q_ + h / h_ * (a_ - q_);
}

/// Of implicit Euler where the step is to begin anew.
void History::set_map(double h, bool goes_on, bool anew, StepSystem& system) {
  constexpr int starts = 3;  // steps: to places that constraints allow, to velocities that they allow, and
                             // one that tells what goes on
  Problem& problem = system.problem;
  const bool unknown_forces = problem.hard_constraints ||
                              (system.rows.contacts && integrator_->begins_anew && !integrator_->rebounds);
  const bool known = goes_on && (gone_on_ >= starts || !problem.hard_constraints);
  const StepStart start{problem.method, h, known ? h_ : infinity, known || !unknown_forces};
  problem.coefficients = (anew ? implicit_euler : integrator_->coefficients)(start);
  const StepCoefficients& c = problem.coefficients;
  StepMap& map = problem.map;
  map.d = c.d;
  map.s = c.s;
  map.h = h;
  map.x0 = problem.start_x;
  map.v_free = problem.start_v + map.s * acceleration_;
  problem.x_time = problem.start_time + h / c.extension;
  if (c.x_v != 0) map.x0 += c.x_v * problem.start_v;
  if (c.x_a != 0) map.x0 += c.x_a * a_;
  if (c.x_a != 0 && pressed_.cols() > 0) map.x0 += c.x_a / h_ * pressed_;
  if (c.v_q != 0) map.v_free += c.v_q * q_;
  if (c.v_a != 0) map.v_free += c.v_a * a_;
  if (c.before != 0) {
    map.x0 += c.before * (problem.start_x - x_);
    map.v_free += c.before * (problem.start_v - v_);
    if (pressed_.cols() > 0) map.v_free -= c.before * pressed_;
  }
}

void History::begin_step(double h, const State& state, StepSystem& system) {
  Problem& problem = system.problem;
  continued_ = is_where_it_ended(state);
  const bool goes_on = this->goes_on(system, state);
  gone_on_ = goes_on ? gone_on_ + 1 : 0;
  if (goes_on && integrator_->keeps == Keeps::states) {  // a body's arc, from where it begins now
    const int count = problem.bodies.count();
    x_.rightCols(count) = -problem.coefficients.extension * system.at.x.rightCols(count);
  }
  problem.bodies.begin(state, problem.start_x, problem.start_v);
  problem.start_time = state.time;
  placed(problem, problem.start_x, problem.start_poses, state.time);
  set_given_accelerations(
      problem.scene, {problem.bodies, problem.start_poses, problem.start_v, integrator_->explicit_forces},
      acceleration_);
  if (integrator_->explicit_forces)
    for (const Slot& slot : system.slots)
      slot.source->add_compliant_forces(problem.start(), problem.start_v, problem.inverse_mass,
                                        acceleration_);
  if (!goes_on) pressed_.setZero();
  if (integrator_->keeps == Keeps::accelerations) carry_on(h, goes_on, system);
  set_map(h, goes_on, false, system);
  if (begin_sources(false, system)) ++system.rows.generation;
  struck_ = false;
  begin_again_if_struck(system);
  h_ = 0;  // until the step has ended
  if (integrator_->keeps == Keeps::nothing) return;
  x_ = problem.start_x;
  v_ = problem.start_v;
}

bool History::begin_again_if_struck(StepSystem& system) {
  if (struck_ || !strikes(system)) return false;
  struck_ = true;
  set_map(system.problem.map.h, false, true, system);
  if (begin_sources(true, system)) ++system.rows.generation;
  return true;
}

StepBegin History::step_begin(const Problem& problem, const Configuration& start, const Configuration& ahead,
                              const Configuration& behind) const {
  return {.bodies = problem.bodies,
          .map = problem.map,
          .coefficients = problem.coefficients,
          .at = start,
          .ahead = ahead,
          .behind = behind,
          .v = problem.start_v,
          .a = a_,
          .inverse_mass = problem.inverse_mass,
          .limits = Limits::silent,
          .tolerance = problem.method.tolerance,
          .solved = false,
          .warm_start = problem.method.warm_start,
          .continued = continued_,
          .after_miss = after_miss()};
}

Widened History::widen(StepSystem& system, double tolerance) const {
  const Configuration start = system.problem.start();
  StepBegin begin = step_begin(system.problem, start, start, start);
  begin.tolerance = tolerance;
  begin.solved = tolerance <= system.problem.method.tolerance;
  const Configuration reached{system.at.x, system.at.poses, system.problem.x_time};
  Widened widened = Widened::no;
  for (Slot& slot : system.slots) {
    const Widened found = slot.source->widen(begin, reached, slot.blocks(system.rows));
    if (found >= Widened::others) ++system.rows.generation;
    widened = std::max(widened, found);
  }
  return widened;
}

bool History::hold_back(StepSystem& system, std::vector<double>& share) const {
  const Configuration start = system.problem.start();
  const StepBegin begin = step_begin(system.problem, start, start, start);
  const Configuration reached{system.at.x, system.at.poses, system.problem.x_time};
  bool any = false;
  for (Slot& slot : system.slots) any |= slot.source->hold_back(begin, reached, share);
  return any;
}

/// Gets the sources ready for the step of the system's map; true if their rows are others than before.
bool History::begin_sources(bool anew, StepSystem& system) {
  const Problem& problem = system.problem;
  const auto damped = [](const Slot& slot) { return slot.source->kind().damped; };
  const double d = std::any_of(system.slots.begin(), system.slots.end(), damped) ? problem.coefficients.d : 0;
  ahead_x_ = problem.start_x + d * problem.start_v;
  behind_x_ = problem.start_x - d * problem.start_v;
  const Configuration start = problem.start(),
                      ahead = placed(problem, ahead_x_, ahead_poses_, problem.start_time),
                      behind = placed(problem, behind_x_, behind_poses_, problem.start_time);
  StepBegin begin = step_begin(problem, start, ahead, behind);
  // What carries accelerations on over-pulls from the chord's velocity at which a step of implicit Euler
  // ends: a rope would slacken and catch again and again.
  const bool told = integrator_->begins_anew && !anew;
  if (told) begin.limits = integrator_->keeps == Keeps::states ? Limits::stops : Limits::holds;
  bool others = false;
  for (Slot& slot : system.slots) others |= slot.source->begin_step(begin, slot.blocks(system.rows));
  return others;
}

void History::end_step(double h, const StepSystem& system, bool missed, State& state) {
  missed_ = missed;
  const Problem& problem = system.problem;
  const double extension = problem.coefficients.extension;
  if (extension == 1) {
    problem.bodies.end(system.at.x, system.at.v, state);
  } else {
    end_x_ = problem.start_x + extension * (system.at.x - problem.start_x);
    end_v_ = problem.start_v + extension * (system.at.v - problem.start_v);
    problem.bodies.end(end_x_, end_v_, state);
  }
  state.time += h;
  if (integrator_->keeps != Keeps::nothing) h_ = strikes(system) ? 0 : h;
  find_pressed(system);
  keep_end(system, state);
}

void History::diverge(const StepSystem& system, const State& state) {
  h_ = 0;
  missed_ = true;
  keep_end(system, state);
}

void History::keep_end(const StepSystem& system, const State& state) {
  if (system.problem.bodies.count() > 0 || system.rows.contacts) ended_ = state;
}

}  // namespace pbd
