// What do threads gain, and does a result depend on them? How near do sweeps come to what memory gives?
// The bytes that a sweep moves at least (harness/rows_of_step.h) are told a second, as a share of what
// copying memory moves in the same run on as many threads.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include <fmt/format.h>

#include "harness/files.h"
#include "harness/measure.h"
#include "harness/rows_of_step.h"
#include "scenes/scene_file.h"
#include "scenes/standard.h"
#include "step/step.h"
#include "studies/cost/roofline.h"
#include "studies/cost/swept.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;
using SteadyClock = std::chrono::steady_clock;

constexpr std::size_t repeats = 5;  // of whole steps

/// Bytes a second that copying 256 MB moves, read and written.
double copied_bytes_per_s(int threads) {
  const Eigen::Index columns = 5'592'405;  // of 24 bytes
  const Points from = Points::Ones(3, columns);
  Points to = Points::Zero(3, columns);
  const auto seconds = repeated_seconds([&] {
    each_columns(threads, columns, [&](Eigen::Index first, Eigen::Index count) {
      to.middleCols(first, count) = from.middleCols(first, count);
    });
  });
  return 2.0 * 24 * static_cast<double>(columns) / *std::min_element(seconds.begin(), seconds.end());
}

bool same_bits(const Points& a, const Points& b) {
  return a.size() == b.size() && std::equal(a.data(), a.data() + a.size(), b.data());
}

/// Of each repeat, time over that of one thread.
std::vector<double> shares(const std::vector<double>& one, const std::vector<double>& several) {
  std::vector<double> all;
  for (std::size_t k = 0; k < one.size(); ++k) all.push_back(several[k] / one[k]);
  return all;
}

struct Gains {
  WorstSpread jacobi, coloured, steps;  // time on two threads over that on one
  WorstSpread copies;                   // time of a sweep over that of copying its bytes
  double differing = 0;
  std::int64_t compared = 0;
};

Scene links_of(int links) {
  return cloth(static_cast<int>(std::lround(std::sqrt(links / 3.0))), true);
}

void sweep_scene(Context& context, Table& table, const std::string& name, Scene scene, int cores,
                 const std::vector<double>& copied, Gains& gains) {
  stir(scene);
  const LinearStep step = linear_step(scene, scene.initial, 1.0 / 240);
  const auto moved = static_cast<double>(least_bytes(step.rows));
  for (const std::string relaxation :
       {"gauss_seidel", "coloured_gauss_seidel", "jacobi", "nesterov_jacobi", "conjugate_gradients"}) {
    Swept one;
    for (int threads = 1; threads <= (relaxation == "gauss_seidel" ? 1 : cores); ++threads) {
      Swept found = swept(step.rows, step.v_free, relaxation, threads);
      if (threads == 1) one = found;
      const Measured share_of_one(shares(one.seconds, found.seconds));
      const Measured seconds(found.seconds);
      const double copy = copied[static_cast<std::size_t>(threads - 1)];
      const bool same = same_bits(one.v, found.v);
      table.row({name, relaxation, std::int64_t{threads}, constraints_of(step.rows), row_count(step.rows),
                 static_cast<std::int64_t>(moved), seconds.value, seconds.low, seconds.high,
                 moved / seconds.value, copy, moved / seconds.value / copy, 1 / share_of_one.value,
                 std::int64_t{same}, "ok", ""});
      const auto owner = fmt::format("{}, {}", relaxation, name);
      if (threads == 1 && (relaxation == "gauss_seidel" || relaxation == "nesterov_jacobi")) {
        std::vector<double> copies = found.seconds;
        for (double& each : copies) each *= copy / moved;
        gains.copies.add(Measured(copies), owner);
      }
      if (threads == 1) continue;
      gains.differing += !same;
      ++gains.compared;
      if (threads != 2) continue;
      if (relaxation == "coloured_gauss_seidel")
        gains.coloured.add(share_of_one, owner);
      else
        gains.jacobi.add(share_of_one, owner);
    }
    context.advance(fmt::format("{} {}", name, relaxation));
  }
}

/// A scene in motion: the frames that are timed begin at `from`.
struct Moving {
  std::string scene, relaxation;
  int from, frames;
};

struct Timed {
  double seconds;
  State end;
};

Timed timed_frames(const SceneFile& file, const State& begin, int frames, std::string_view relaxation,
                   int threads) {
  Method method = file.method;
  method.relaxation = relaxation;
  method.threads = threads;
  Workspace workspace(file.scene, method);
  State state = begin;
  const auto start = SteadyClock::now();
  for (int k = 0; k < frames; ++k) step(workspace, file.step_s, state);
  return {std::chrono::duration<double>(SteadyClock::now() - start).count(), state};
}

void step_scene(Context& context, Table& table, const Moving& moving, int cores, Gains& gains) {
  const SceneFile file = read_scene_file(source_root() / "experiments/scenes" / (moving.scene + ".toml"));
  const State begin = timed_frames(file, file.scene.initial, moving.from, moving.relaxation, cores).end;
  std::vector<double> one;
  Points end;
  for (int threads = 1; threads <= cores; ++threads) {
    std::vector<double> seconds;
    State state;
    for (std::size_t k = 0; k < repeats; ++k) {
      Timed run = timed_frames(file, begin, moving.frames, moving.relaxation, threads);
      seconds.push_back(run.seconds / moving.frames);
      state = run.end;
    }
    if (threads == 1) one = seconds, end = state.x;
    const bool same = same_bits(end, state.x);
    const Measured share_of_one(shares(one, seconds));
    const Measured told(seconds);
    table.row({moving.scene, file.method.integrator, file.method.outer, moving.relaxation,
               std::int64_t{threads}, std::int64_t{moving.from}, std::int64_t{moving.frames}, told.value,
               told.low, told.high, 1 / share_of_one.value, std::int64_t{same}, "ok", ""});
    if (threads == 1) continue;
    gains.differing += !same;
    ++gains.compared;
    if (threads == 2) gains.steps.add(share_of_one, moving.scene);
  }
  context.advance(moving.scene);
}

}  // namespace

void threads(Context& context) {
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int links = context.full() ? 1'000'000 : 300'000, tets = context.full() ? 300'000 : 100'000;
  const std::vector<Moving> moving{{"boxes_on_ground", "coloured_gauss_seidel", 40, context.full() ? 20 : 5},
                                   {"flexible_cow", "conjugate_gradients", 40, context.full() ? 60 : 20}};
  const auto effects = rows_of_effects();
  context.begin(2 * 5 + std::ssize(moving) + std::ssize(effects));
  std::vector<double> copied;
  for (int count = 1; count <= cores; ++count) copied.push_back(copied_bytes_per_s(count));
  Gains gains;
  Table sweeps = context.table(
      "sweeps", {"scene", "relaxation", "threads", "constraints", "rows", "bytes", "wall_s_per_sweep",
                 "wall_s_low", "wall_s_high", "bytes_per_s", "copied_bytes_per_s", "share_of_copy", "speedup",
                 "same_bits", "status", "reason"});
  sweep_scene(context, sweeps, "cloth", links_of(links), cores, copied, gains);
  sweep_scene(context, sweeps, "solid", clamped_cube(tets), cores, copied, gains);
  Table steps = context.table(
      "steps", {"scene", "integrator", "outer", "relaxation", "threads", "first_step", "steps",
                "wall_s_per_step", "wall_s_low", "wall_s_high", "speedup", "same_bits", "status", "reason"});
  for (const Moving& each : moving) step_scene(context, steps, each, cores, gains);
  sweeps.close();
  steps.close();
  roofline(context, effects, copied);

  context.verdict(Basis::robustness, "threads.same",
                  "the same scene ends in the same bits, whatever the number of threads",
                  fmt::format("of {} runs on several threads those that end otherwise", gains.compared),
                  gains.differing, 0);
  const auto of = [](const WorstSpread& worst) { return fmt::format(" ({})", worst.owner()); };
  context.verdict(Basis::goal, "threads.bandwidth",
                  "one thread sweeps its rows at six tenths of the speed of copying memory, or faster",
                  "time of a sweep over that of copying its bytes" + of(gains.copies), gains.copies.value(),
                  1 / 0.6);
  if (cores < 2) return;
  const std::string time = "time over that of one thread";
  context.verdict(Basis::goal, "threads.jacobi", "two threads sweep Jacobi's family 1.7 times as fast",
                  time + of(gains.jacobi), gains.jacobi.value(), 1 / 1.7);
  context.verdict(Basis::goal, "threads.coloured", "two threads sweep by colours 1.5 times as fast",
                  time + of(gains.coloured), gains.coloured.value(), 1 / 1.5);
  context.verdict(Basis::goal, "threads.steps", "two threads step pile and cow 1.5 times as fast",
                  time + of(gains.steps), gains.steps.value(), 1 / 1.5);
}

}  // namespace pbdcheck
