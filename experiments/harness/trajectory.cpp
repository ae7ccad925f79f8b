#include "harness/trajectory.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <optional>

#include "error.h"
#include "harness/allocated_memory.h"
#include "harness/contact_sums.h"
#include "harness/interrupt.h"
#include "harness/measure.h"
#include "harness/probes.h"
#include "harness/progress.h"
#include "harness/stepper.h"
#include "ode.h"

namespace pbdcheck {

using namespace pbd;

namespace {

struct OutOfTime {};

Points all_places(const Scene& scene, const State& state) {
  return places(scene, state.x, state.orientation);
}

/// m, that counts as moving.
double shortest_way(const Scene& scene) {
  const Points start = all_places(scene, scene.initial);
  return start.cols() > 0 ? least_way * (start.rowwise().maxCoeff() - start.rowwise().minCoeff()).norm() : 0;
}

double distance(const Scene& scene, const State& end, const State& truth) {
  return relative_error(all_places(scene, end), all_places(scene, truth), all_places(scene, scene.initial),
                        shortest_way(scene));
}

}  // namespace

Trajectory trajectory(const SceneFile& file, double duration, const Setting& setting, const Limits& limits) {
  using Clock = std::chrono::steady_clock;
  const auto since = [](Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  SceneFile moved = file;
  moved.step_s = duration / static_cast<double>(setting.steps);
  Trajectory found;
  found.end = file.scene.initial;
  auto clock = Clock::now();
  Workspace workspace(file.scene, setting.method);
  Stepper stepper(moved, workspace);
  found.wall_s = since(clock);
  if (std::isfinite(limits.wall_s))
    stepper.watch([&] {
      if (found.wall_s + since(clock) > limits.wall_s) throw OutOfTime();
    });
  SlowNotice notice(fmt::format("{} steps by {}, {}, {}", setting.steps, setting.method.integrator,
                                setting.method.outer, setting.method.relaxation));
  for (std::int64_t k = 1; k <= setting.steps && found.status == Status::ok; ++k) {
    notice.poll();
    clock = Clock::now();
    Report report;
    try {
      report = stepper.whole(found.end);
    } catch (const OutOfTime&) {  // told by the time, below
    }
    found.wall_s += since(clock);
    found.outer_iterations += report.outer_iterations;
    found.sweeps += report.sweeps;
    found.row_updates += report.row_updates;
    found.missed_steps += report.status != Status::ok;
    if (found.wall_s > limits.wall_s) {
      found.status = Status::not_converged;
      found.reason = fmt::format("given up after {:.2g} s in step {} of {}", limits.wall_s, k, setting.steps);
      break;
    }
    const std::vector<ContactForce> contacts = workspace.contacts();
    found.penetration_m = std::max(found.penetration_m, -least_gap(contacts).value_or(0));
    if (pressing(contacts) > 0) found.touched_s = std::min(found.touched_s, found.end.time);
    if (report.status == Status::diverged || (report.status != Status::ok && !setting.by_count)) {
      found.status = report.status;
      found.reason = fmt::format("step {}: {}", k, report.reason);
    } else if (!(way(file.scene, found.end) <= limits.way_m)) {
      found.status = Status::diverged;
      found.reason = fmt::format("step {}: farther than {:.2g} m from the start", k, limits.way_m);
    }
  }
  for (const EffectCost& cost : workspace.costs()) found.rows += cost.rows, found.bytes += cost.bytes;
  return found;
}

std::vector<Cell> method_cells(const Scene& scene, const Method& method) {
  const auto none = [](bool without, const std::string& name) {
    return without ? std::string("none") : name;
  };
  return {method.integrator, method.outer, none(method.outer == "quasi_newton", method.relaxation),
          none(contact_of(scene) == nullptr, method.friction), method.tolerance};
}

std::vector<Cell> work_cells(const Trajectory& found) {
  return {found.outer_iterations, found.sweeps, found.row_updates,
          found.missed_steps,     found.bytes,  found.wall_s};
}

Trajectory timed_trajectory(const SceneFile& file, double duration, const Setting& setting,
                            const Limits& limits) {
  constexpr double enough = 0.02;  // s: twenty times what a scheduler takes a core away for
  Trajectory best = trajectory(file, duration, setting, limits);
  double spent = best.wall_s;
  for (int repeat = 1; repeat < timed_repeats && spent < enough && best.status == Status::ok; ++repeat) {
    const double again = trajectory(file, duration, setting).wall_s;
    spent += again;
    best.wall_s = std::min(best.wall_s, again);
  }
  return best;
}

double step_memory_mb(const SceneFile& file, double duration, const Setting& setting, const State& state) {
  const auto measured = [&] {
    SceneFile moved = file;
    moved.step_s = duration / static_cast<double>(setting.steps);
    State end = state;
    const AllocatedMemory memory;
    Workspace workspace(file.scene, setting.method);
    Stepper stepper(moved, workspace);
    double most = 0;
    stepper.watch([&] { most = std::max(most, memory.megabytes()); });
    stepper.whole(end);
    return std::max(memory.megabytes(), most);  // also where it is NaN
  };
  return std::async(std::launch::async, measured).get();
}

double error_scale(const Scene& scene, const State& truth) {
  return std::max(way(scene, truth), shortest_way(scene));
}

double end_error(const Scene& scene, const Trajectory& found, const State& truth) {
  return found.status == Status::ok ? distance(scene, found.end, truth) : std::nan("");
}

double way(const Scene& scene, const State& end) {
  const Points moved = all_places(scene, end) - all_places(scene, scene.initial);
  return moved.cols() > 0 ? moved.colwise().norm().maxCoeff() : 0;
}

void require_ode(const SceneFile& file) {
  if (!file.script.empty())
    throw SetupError("scene", "what changes with time", "nothing that does: the ODE has one force");
  reference::ode(file.scene, {});
}

Truth ode_truth(const SceneFile& file, double duration, reference::OdeSettings settings) {
  require_ode(file);
  settings.poll =
      [notice = SlowNotice(fmt::format("ode integrates the motion to t = {:g} s", duration))]() mutable {
        throw_if_interrupted();
        notice.poll();
      };
  const auto found = reference::ode(file.scene, {duration}, settings);
  Truth truth{.end = file.scene.initial, .method = "ODE of order 8", .reason = found.reason};
  if (found.outcome != reference::Outcome::ok) return truth;
  truth.end = found.samples[0];
  double metres = found.position_error[0], arm = 0;
  for (const RigidBody& body : file.scene.bodies)
    if (body.inertia.allFinite()) arm = std::max(arm, gyration_radii(file.scene, body).maxCoeff());
  if (arm > 0) metres += arm * found.orientation_error[0];
  truth.error_bar = metres / error_scale(file.scene, truth.end);
  return truth;
}

Truth finer_steps_truth(const SceneFile& file, double duration, const Setting& finest, double wall_s) {
  Setting coarser = finest;
  coarser.steps /= 2;
  const Trajectory fine = trajectory(file, duration, finest, {.wall_s = wall_s});
  const Method& method = finest.method;
  Truth truth{.end = fine.end,
              .method = fmt::format("{} steps by {}, {}, {}, tolerance {:g}", finest.steps, method.integrator,
                                    method.outer, method.relaxation, method.tolerance),
              .touched = std::isfinite(fine.touched_s),
              .wall_s = fine.wall_s,
              .in_time = fine.wall_s <= wall_s,
              .reason = fine.reason};
  if (fine.status != Status::ok) return truth;
  const Trajectory coarse =
      trajectory(file, duration, coarser, {.wall_s = std::max(0.0, wall_s - fine.wall_s)});
  truth.error_bar = end_error(file.scene, coarse, fine.end);
  truth.wall_s += coarse.wall_s;
  truth.in_time = truth.wall_s <= wall_s;
  truth.reason = coarse.reason;
  if (truth.reason.empty() && !std::isfinite(truth.error_bar)) truth.reason = "the end is not finite";
  return truth;
}

Truth agreed_truth(const SceneFile& file, double duration, Setting finest,
                   const std::vector<std::string>& integrators, double wall_s) {
  std::optional<Truth> first, best;
  double spent = 0;
  for (const std::string& integrator : integrators) try {
      if (first && (std::isnan(first->error_bar) || spent >= wall_s)) break;
      finest.method.integrator = integrator;
      const Truth truth = finer_steps_truth(file, duration, finest, std::max(0.0, wall_s - spent));
      spent += truth.wall_s;
      if (!first) first = best = truth;
      const double apart = distance(file.scene, truth.end, first->end);
      if (truth.error_bar < best->error_bar && apart <= 3 * (truth.error_bar + first->error_bar))
        best = truth;
    } catch (const SetupError&) {  // not for this scene
      if (!first) throw;
    }
  best->wall_s = spent;
  return *best;
}

double energy_error(const Scene& scene, const Trajectory& found, const State& truth) {
  if (found.status != Status::ok) return std::nan("");
  const double moving = kinetic_energy(scene, truth) + elastic_energy(scene, truth);
  const double before = gravity_energy(scene, scene.initial), after = gravity_energy(scene, truth);
  const double turned_over = moving + std::abs(after - before);
  const double difference = std::abs(total_energy(scene, found.end) - total_energy(scene, truth));
  const double rounding = rounded_place * (std::abs(before) + std::abs(after));
  return turned_over > rounding ? difference / turned_over : difference;
}

}  // namespace pbdcheck
