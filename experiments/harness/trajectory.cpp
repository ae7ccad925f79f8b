#include "harness/trajectory.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "error.h"
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

double distance(const Scene& scene, const State& end, const State& truth) {
  return relative_error(all_places(scene, end), all_places(scene, truth), all_places(scene, scene.initial));
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
      found.reason = fmt::format("given up after {:.2g} s", limits.wall_s);
      break;
    }
    found.penetration_m = std::max(found.penetration_m, -least_gap(workspace.contacts()).value_or(0));
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
  Truth truth{file.scene.initial, std::nan(""), "ODE of order 8", found.reason};
  if (found.outcome != reference::Outcome::ok) return truth;
  truth.end = found.samples[0];
  double metres = found.position_error[0], arm = 0;
  for (const RigidBody& body : file.scene.bodies)
    if (body.inertia.allFinite()) arm = std::max(arm, gyration_radii(file.scene, body).maxCoeff());
  if (arm > 0) metres += arm * found.orientation_error[0];
  const double moved = way(file.scene, truth.end);
  truth.error_bar = moved > 0 ? metres / moved : metres;
  return truth;
}

Truth richardson_truth(const SceneFile& file, double duration, const Setting& finest) {
  Setting coarser = finest;
  coarser.steps /= 2;
  const Trajectory fine = trajectory(file, duration, finest);
  const Trajectory coarse = trajectory(file, duration, coarser);
  const double bar = end_error(file.scene, coarse, fine.end);
  const Method& method = finest.method;
  std::string reason = fine.status == Status::ok ? coarse.reason : fine.reason;
  if (reason.empty() && !std::isfinite(bar)) reason = "the end is not finite";
  return {fine.end, fine.status == Status::ok ? bar : std::nan(""),
          fmt::format("{} steps by {}, {}, {}, tolerance {:g}", finest.steps, method.integrator, method.outer,
                      method.relaxation, method.tolerance),
          reason};
}

Truth agreed_truth(const SceneFile& file, double duration, Setting finest,
                   const std::vector<std::string>& integrators) {
  std::optional<Truth> first, best;
  for (const std::string& integrator : integrators) try {
      finest.method.integrator = integrator;
      const Truth truth = richardson_truth(file, duration, finest);
      if (!first) first = best = truth;
      const double apart = distance(file.scene, truth.end, first->end);
      if (truth.error_bar < best->error_bar && apart <= 3 * (truth.error_bar + first->error_bar))
        best = truth;
    } catch (const SetupError&) {  // not for this scene
      if (!first) throw;
    }
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
