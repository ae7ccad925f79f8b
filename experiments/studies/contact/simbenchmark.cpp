// SimBenchmark (kang2018simbenchmark): accuracy of contact against step and time, beside what it published of
// five engines.
//
//   rolling       a box of 10 kg with 25 balls of 1 kg on it is pushed by 150 N, along y or askew: mean of
//                 |v_box - a_box t|^2 + |v_ball - a_ball t|^2 over all steps, the first ball's
//   bouncing      49 balls of 10 kg fall by 4.9 m and bounce without loss: mean of (E - E_0)^2
//   666           6 x 6 x 6 balls of 10 kg fall together without friction: mean of the sum of the squared
//                 overlaps of balls, and with the ground
//   elastic_666   the same from 1 m higher, bouncing without loss: mean of (E - E_0)^2
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "harness/measure.h"
#include "harness/step_checks.h"
#include "step/step.h"
#include "studies/contact/simbenchmark.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;

struct BenchmarkOutcome {
  double error = 0, wall = 0;
  std::int64_t sweeps = 0, missed = 0, outer = 0, row_updates = 0;
  Status status = Status::ok;
  std::string reason;
};

BenchmarkOutcome run_benchmark(const Benchmark& each, const Method& method, double h) {
  BenchmarkOutcome outcome;
  Workspace workspace(each.scene, method);
  State state = each.scene.initial;
  StepChecks checks;
  const auto steps = static_cast<std::int64_t>(std::lround(each.duration / h));
  for (std::int64_t k = 0; k < steps; ++k) {
    throw_if_interrupted();
    outcome.error += each.error(state) / static_cast<double>(steps);
    const State before = state;
    const auto start = std::chrono::steady_clock::now();
    const Report report = step(workspace, h, state);
    outcome.wall += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    outcome.sweeps += report.sweeps;
    outcome.outer += report.outer_iterations;
    outcome.row_updates += report.row_updates;
    outcome.missed += report.status != Status::ok;
    if (report.status > outcome.status) outcome.status = report.status, outcome.reason = report.reason;
    if (report.status != Status::diverged)
      checks.add(k + 1, claim_of(each.scene, workspace, before, state, h, report), report.status, false);
    if (checks.refuted_steps() > 0) outcome.status = Status::diverged, outcome.reason = checks.text();
    if (outcome.status == Status::diverged) {
      outcome.error = std::nan("");
      break;
    }
  }
  return outcome;
}

/// The least published error of a benchmark at 1 ms.
double best_published(std::string_view benchmark) {
  double least = infinity;
  for (const Published& each : published)
    if (each.benchmark == benchmark && each.step == 1e-3) least = std::min(least, each.error);
  return least;
}

}  // namespace

void simbenchmark(Context& context) {
  constexpr double at = 1e-3;  // s, where verdicts are taken
  std::vector<std::pair<Benchmark, std::vector<double>>> runs;
  const bool full = context.full();
  const auto steps = [&](std::vector<double> quick, std::vector<double> more) {
    if (full) quick.insert(quick.end(), more.begin(), more.end());
    return quick;
  };
  runs.emplace_back(rolling_balls(std::acos(0.5), "xy"), steps({4e-3, at}, {}));
  runs.emplace_back(rolling_balls(std::acos(0.0), "y"), steps({4e-3, at}, {}));
  runs.emplace_back(bouncing_balls(), steps({1e-2, at}, {1e-4}));
  runs.emplace_back(cube_of_balls(false), steps({4e-2, 1e-2}, {4e-3, at}));
  runs.emplace_back(cube_of_balls(true), steps({1e-2, at}, {}));
  std::int64_t units = 0;
  for (const auto& [benchmark, h] : runs) units += std::ssize(h);
  context.begin(units);

  Table table = context.table(
      "accuracy", {"benchmark", "solver", "step_s", "integrator", "alpha", "outer", "relaxation", "friction",
                   "error", "simulated_s", "outer_iterations", "sweeps", "row_updates", "missed_steps",
                   "wall_s", "cpu_s", "status", "reason"});
  for (const auto& [benchmark, list] : runs)
    for (const double h : list) {
      Method method;
      method.integrator = benchmark.integrator;
      method.alpha = 0.5;
      method.tolerance = 1e-10;
      const BenchmarkOutcome found = run_benchmark(benchmark, method, h);
      table.row({benchmark.name, std::string("pbdcheck"), h, method.integrator, method.alpha, method.outer,
                 method.relaxation, method.friction, found.error, benchmark.duration, found.outer,
                 found.sweeps, found.row_updates, found.missed, found.wall, not_given,
                 std::string(status_names[static_cast<std::size_t>(found.status)]), found.reason});
      context.advance(fmt::format("{} at {:g} s", benchmark.name, h));
      if (h != at) continue;
      context.verdict(Basis::goal, "simbenchmark." + benchmark.name,
                      "not worse than the best published figure at 1 ms", "mean squared error", found.error,
                      best_published(benchmark.name));
    }
  const std::string unknown;
  for (const Published& each : published)
    table.row({std::string(each.benchmark), std::string(each.engine), each.step, unknown, not_given, unknown,
               unknown, unknown, each.error, not_given, not_given, not_given, not_given, not_given, not_given,
               each.seconds, std::string("ok"), unknown});
  table.close();
}

}  // namespace pbdcheck
