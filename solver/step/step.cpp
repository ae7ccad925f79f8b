#include <algorithm>
#include <cmath>

#include "step/levels.h"
#include "step/turns.h"
#include "step/workspace.h"
#include "validate.h"

namespace pbd {
namespace {

/// Iterates with the rows that count where all later ones are worse than the start alone: on the way to a
/// solution one may well be better in sum and miss more constraints.
constexpr int early = 10;

/// Keeps the iterate if it is the best one.
void keep_if_best(const StepSystem& system, const Progress& progress, BestIterate& best) {
  if (!(progress.residual() < best.residual)) return;
  best.residual = progress.residual();
  best.v = system.at.v;
  keep_impulses_and_biases(system.rows, best.rows);
}

/// True if something collides that was not to.
bool collide(StepSystem& system, double accuracy) {
  bool any = false;
  for (Slot& slot : system.slots) any |= slot.source->collide(slot.view(system.rows), system.at.v, accuracy);
  return any;
}

/// Rounds in a row that find other rows and leave the iterate where it is: it will call for the same again.
constexpr int most_in_place = 10;

/// Of the scale: solved far enough to tell what else is met.
double nearly(const Method& method) {
  constexpr double least = 1e-4, coarser = 10;  // times the tolerance
  return std::max(least, coarser * method.tolerance);
}

/// One step in the making.
struct StepRun {
  WorkspaceData& w;
  Levels levels{};
  Progress progress{};
  Report report{};
  double first_of_rows = 0;  // residual, sqrt(J)
  bool looked = false;       // for other rows than these
  bool slowed = false;       // by no force: the next step begins anew

  void begin(double h, const State& state);
  void solve(const Observer& observer);
  void restrain();
  void hold_back();
  void end(double h, State& state);

 private:
  bool settle_here(bool stalled);
  bool stalls();
  bool looks_early();
  bool widen(double tolerance);
  bool find_other_rows();
  void begin_rows();
  void begin_iteration();
  void take_best();
  void measure_here() { measure(w.system, refresh(w.outer, w.system), w.effects, levels, progress); }
};

void StepRun::begin(double h, const State& state) {
  StepSystem& system = w.system;
  if (!w.method.warm_start) {
    forget(system.solver);
    w.contraction.forget();
  }
  w.history.begin_step(h, state, system);
  if (!w.method.warm_start) clear_impulses(system.rows);
  if (!w.history.after_miss() || !w.method.warm_start) w.restraint.forget();
  begin_iteration();
  progress.contraction = w.contraction.value();
}

/// From where the step begins, by its map.
void StepRun::begin_iteration() {
  StepSystem& system = w.system;
  system.at.v = system.problem.start_v;
  pbd::begin(w.outer, system);
  const auto& inverse_mass = system.problem.inverse_mass;
  levels.free_change = mass_distance(inverse_mass, system.problem.map.v_free, system.problem.start_v);
  levels.free_speed = mass_norm(inverse_mass, system.problem.map.v_free);
}

/// True if v has arrived and the residual no longer falls: the impulses may go on where v has arrived.
bool StepRun::stalls() {
  constexpr double falling = 0.5;
  const double now = progress.residual();
  const bool stalled =
      progress.iterations_of_rows > 0 &&
      progress.change <= rounding_unit * mass_norm(w.system.problem.inverse_mass, w.system.at.v) &&
      !(now < falling * levels.last_residual);
  levels.last_residual = now;
  return stalled;
}

/// True if the iterate ends the step once its impulses are settled.
bool StepRun::settle_here(bool stalled) {
  const auto found = settle(w.outer, w.system, progress, stalled);
  if (!found) return false;
  measure(w.system, *found, w.effects, levels, progress);
  if (finished(w.method, levels, progress, report)) return true;
  unsettle(w.outer, w.system);
  return false;
}

/// True once of these rows, where the iterate is nearly solved and much nearer than it began: others that it
/// calls for need not wait.
bool StepRun::looks_early() {
  constexpr double fallen = 0.1;
  if (looked) return false;
  looked = progress.residual() <= std::min(nearly(w.method) * progress.scale, fallen * first_of_rows);
  return looked;
}

/// Finds rows that an iterate calls for which is solved to a tolerance; true if there are any. Where they do
/// not tell how it came where it is, the iterate begins anew.
bool StepRun::widen(double tolerance) {
  const Widened found = w.history.widen(w.system, tolerance);
  if (found == Widened::others_from_start) begin_iteration();
  return found != Widened::no;
}

/// True if the solved iterate calls for other rows.
bool StepRun::find_other_rows() {
  return widen(w.method.tolerance) || collide(w.system, w.method.tolerance * progress.scale);
}

/// The step begins, with these rows, at the iterate.
void StepRun::begin_rows() {
  progress.begin_rows(w.method);
  looked = false;
  w.best_early.residual = w.best.residual = levels.last_residual = infinity;
  w.previous = w.system.at.v;
  measure_here();
  first_of_rows = progress.residual();
  levels.first = std::max({levels.first, progress.residual(), progress.scale});
}

void StepRun::solve(const Observer& observer) {
  StepSystem& system = w.system;
  int solved_anew = 0, in_place = 0;
  begin_rows();
  for (;;) {
    if (observer)
      observer({progress.outer_iterations, progress.sweeps, progress.row_updates, progress.primal,
                progress.dual, progress.scale, system.at.x, system.at.v});
    if (solves_step(w.outer))
      keep_if_best(system, progress, progress.iterations_of_rows < early ? w.best_early : w.best);
    progress.last_change = progress.change;
    progress.change = mass_distance(system.problem.inverse_mass, system.at.v, w.previous);
    const bool stalled = stalls();
    const bool ended = finished(w.method, levels, progress, report) || settle_here(stalled);
    if (ended && report.status == Status::ok && find_other_rows()) {
      const bool stayed = first_of_rows <= w.method.tolerance * progress.scale;
      in_place = stayed ? in_place + 1 : 0;
      forget(w.outer);
      if (w.history.begin_again_if_struck(system)) begin_iteration();
      begin_rows();
      if (++solved_anew <= w.method.max_outer && in_place < most_in_place) continue;
      report.status = Status::not_converged;
      report.reason = "each solution calls for other rows";
    } else if (ended && report.status == Status::ok && turned_round(system)) {
      report.status = Status::not_converged;
      report.reason = "a joint turns a body over or by more than half a turn, which it cannot tell from less";
    }
    if (ended) break;
    if (solved_anew < w.method.max_outer && looks_early() && widen(nearly(w.method))) {
      ++solved_anew;
      forget(w.outer);
      begin_rows();
      continue;
    }
    if (stalled && !takes_over(w.outer)) {
      report.reason = "stalled away from the solution";
      break;
    }
    w.previous = system.at.v;
    pbd::iterate(w.outer, system, progress);
    ++progress.outer_iterations;
    ++progress.iterations_of_rows;
    measure_here();
  }
  if (report.status == Status::not_converged) take_best();
}

/// The best iterate takes the place of the last one.
void StepRun::take_best() {
  const bool astray = !(std::min(w.best.residual, progress.residual()) <= levels.first);
  const BestIterate& best = astray && w.best_early.residual < w.best.residual ? w.best_early : w.best;
  if (!(best.residual < progress.residual())) return;
  w.system.at.v = best.v;
  restore_impulses_and_biases(best.rows, w.system.rows);
  forget(w.outer);
  measure_here();
}

/// A missed step does no harm.
void StepRun::restrain() {
  if (report.status != Status::not_converged || !solves_step(w.outer) || !w.history.integrator().contact)
    return;
  if (w.restraint.restrain(w.system, w.history.given_accelerations())) {
    slowed = true;
    forget(w.outer);
    measure_here();
  }
  hold_back();
  w.restraint.keep_lost(w.system);
}

/// A missed step leads through nothing whose way is looked at. What meets on the way that is left is held
/// back again, soon where it began; what a script leads into it is not stopped.
void StepRun::hold_back() {
  constexpr int patience = 5, most = 2 * patience;
  for (int k = 0; k < most; ++k) {
    w.share.assign(static_cast<std::size_t>(w.system.problem.bodies.columns()), 1.0);
    if (!w.history.hold_back(w.system, w.share)) return;
    if (k >= patience)
      for (double& each : w.share)
        if (each < 1) each = 0;
    if (!w.restraint.shorten(w.system, w.share)) return;
    slowed = true;
    forget(w.outer);
    measure_here();
  }
}

void StepRun::end(double h, State& state) {
  StepSystem& system = w.system;
  if (!system.at.x.allFinite() || !system.at.v.allFinite() || !std::isfinite(state.time + h)) {
    report.status = Status::diverged;
    report.reason = not_finite;
  } else if (h * system.problem.bodies.largest_spin(system.at.v) > most_turn) {
    report.status = Status::diverged;
    report.reason = "a body turns by more than double precision holds to 1e-8 rad";
  }
  if (report.status != Status::ok && report.reason != not_finite) report.worst = worst_constraint(system);
  if (report.status == Status::diverged) {
    clear_impulses(system.rows);
    forget(system.solver);
    w.contraction.forget();
    w.history.diverge(system, state);
  } else {
    w.contraction.update(system, on_potential(w.outer), progress);
    report.contraction = w.contraction.value();
    pbd::end(w.outer, system);
    w.history.end_step(h, system, report.status != Status::ok && solves_step(w.outer), state);
    if (slowed) w.history.begin_anew();
  }
  for (Slot& slot : system.slots) slot.count_rows(system.rows);
  report.outer_iterations = progress.outer_iterations;
  report.sweeps = progress.sweeps;
  report.row_updates = progress.row_updates;
  report.primal = progress.primal;
  report.dual = progress.dual;
  report.scale = progress.scale;
  report.linear_part = progress.linear_part;
}

}  // namespace

Report step(Workspace& workspace, double h, State& state, const Observer& observer) {
  validate(workspace.scene(), h, state);
  StepRun run{*workspace.data_};
  // Orientations are by `validate`.
  if (state.x.allFinite() && state.v.allFinite() && state.spin.allFinite()) {
    run.begin(h, state);
    run.solve(observer);
    run.restrain();
  } else {
    run.report.status = Status::diverged;
    run.report.reason = not_finite;
  }
  run.end(h, state);
  return run.report;
}

}  // namespace pbd
