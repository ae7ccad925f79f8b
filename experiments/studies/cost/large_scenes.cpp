// What does a step of a large scene cost in time and memory? Solids and sheets by quasi_newton and by
// Newton's method, the rival, until the error first falls to a target; columns of boxes by `auto`, which has
// no rival there. What only a scene's first step takes stands apart, as setup_s.
#include <algorithm>
#include <cmath>
#include <map>
#include <new>

#include <fmt/format.h>

#include "harness/peak_memory.h"
#include "scenes/contacts.h"
#include "scenes/standard.h"
#include "studies/cost/contestants.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr double large_targets[]{1e-3, 1e-6};
constexpr double ended = 1e-10;  // of the residual: both methods end so

struct LargeScene {
  std::string_view kind, unit;
  std::int64_t size;
  Scene scene;
};

LargeScene solid(int cells) {
  Scene scene = cantilever(cells, {1e6, 0.3}, Strain::green);
  const std::int64_t size = std::ssize(std::get<TetStrain>(scene.effects.back()).node);
  return {"solid", "tetrahedra", size, std::move(scene)};
}

LargeScene sheet(int cells) {
  return {"cloth", "cells", std::int64_t{cells} * cells, cloth(cells)};
}

/// Boxes on each other, four high, that slide: what moves as they stop is not solved by the last step's
/// impulses.
LargeScene columns(int side) {
  constexpr int high = 4;
  constexpr double size = 0.1;  // m
  BodyScene build({.friction = 0.5});
  build.ground();
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      for (int k = 0; k < high; ++k)
        build.box(Vec3::Constant(size), 1,
                  {.position = size * Vec3(2 * i, 2 * j, k + 0.5), .velocity = {1, 0, 0}});
  return {"columns", "boxes", std::int64_t{high} * side * side, build.finish()};
}

/// A step's points, and what the method took.
struct Costs {
  Trace trace;
  double setup_s = std::nan(""), memory_mb = std::nan("");
  std::string failure;
};

/// The scene's second step, which begins at `start`; the first one is the method's own, so that what it keeps
/// from step to step is as in a running simulation.
Costs costs_of(const Contestant& contestant, const Scene& scene, const State& start, const Points& exact) {
  Costs costs;
  const PeakMemory memory;
  try {
    const double begun = now_s();
    const WatchedStep step = contestant.ready(scene, ended);
    const double first = now_s() - begun + watched(step, scene.initial, start.x).points.back().wall_s;
    costs.trace = watched(step, start, exact);
    costs.setup_s = std::max(0.0, first - costs.trace.points.back().wall_s);
  } catch (const std::bad_alloc&) {
    costs.failure = "memory spent";
  }
  costs.memory_mb = memory.megabytes();
  return costs;
}

class Costing {
 public:
  explicit Costing(Context& context)
      : context_(context),
        table_(context.table(
            "steps", {"scene", "unit", "size", "unknowns", "method", "error_target", "iterations", "setup_s",
                      "wall_s", "memory_mb", "error", "status", "reason"})) {}

  void contest(const LargeScene& large) {
    const Scene& scene = large.scene;
    State start = scene.initial;
    Points exact;
    {
      const WatchedStep step = ready_quasi_newton(scene, ended);
      const auto unwatched = [](int, const Points&) {};
      step(start, unwatched);  // the scene is on its way
      State end = start;
      step(end, unwatched);
      exact = end.x;
    }
    for (const Contestant& contestant : contestants) {
      const Costs costs = costs_of(contestant, scene, start, exact);
      for (const double target : large_targets) add(large, contestant.name, target, costs);
      if (contestant.name == "newton" && !costs.trace.points.empty())
        apart_.add(costs.trace.points.back().error);
      context_.advance(fmt::format("{} {} by {}", large.size, large.unit, contestant.name));
    }
  }

  /// To tolerances of the residual: there is no other answer to compare with.
  void solve(const LargeScene& large) {
    for (const double target : large_targets) {
      Method method;
      method.tolerance = target;
      const PeakMemory memory;
      const double begun = now_s();
      Workspace workspace(large.scene, method);
      State state = large.scene.initial;
      step(workspace, contested_step_s, state);
      const double second = now_s();
      const Report report = step(workspace, contested_step_s, state);
      const double end = now_s();
      row(large, "auto", target, report.outer_iterations, std::max(0.0, 2 * second - begun - end),
          end - second, memory.megabytes(), larger(report.primal, report.dual) / report.scale,
          status_names[static_cast<std::size_t>(report.status)], report.reason);
    }
    context_.advance(fmt::format("{} {}", large.size, large.unit));
  }

  /// Largest ratio of quasi_newton's time to newton's, of scenes of a kind from `least` to `most` in size;
  /// NaN if the target was not reached in one of them.
  double ratio(std::string_view kind, std::int64_t least, std::int64_t most, double target) const {
    Worst worst;
    for (const auto& [key, seconds] : seconds_)
      if (key.kind == kind && key.size >= least && key.size <= most && key.target == target)
        worst.add(seconds.at("quasi_newton") / seconds.at("newton"));
    return worst.value();
  }
  double apart() const { return apart_.value(); }
  void close() { table_.close(); }

 private:
  struct Key {
    std::string_view kind;
    std::int64_t size;
    double target;
    auto operator<=>(const Key&) const = default;
  };

  void add(const LargeScene& large, std::string_view method, double target, const Costs& costs) {
    const auto& points = costs.trace.points;
    const auto first = std::find_if(points.begin(), points.end(),
                                    [=](const TracePoint& point) { return point.error <= target; });
    const bool reached = first != points.end();
    seconds_[{large.kind, large.size, target}][method] = reached ? first->wall_s : std::nan("");
    if (reached)
      return row(large, method, target, first->outer_iterations, costs.setup_s, first->wall_s,
                 costs.memory_mb, first->error, "ok", "");
    const Report& report = costs.trace.report;
    const bool ran = costs.failure.empty();
    row(large, method, target, report.outer_iterations, costs.setup_s, std::nan(""), costs.memory_mb,
        ran ? points.back().error : std::nan(""), "not_converged",
        !ran                    ? costs.failure
        : report.reason.empty() ? "ended above the target"
                                : report.reason);
  }

  void row(const LargeScene& large, std::string_view method, double target, std::int64_t iterations,
           double setup_s, double wall_s, double memory_mb, double error, std::string_view status,
           std::string_view reason) {
    const Scene& scene = large.scene;
    // A body's node has its mass; three more are its rotation's.
    const auto moves = [](double mass) { return std::isfinite(mass); };
    const auto nodes = std::count_if(scene.mass.begin(), scene.mass.end(), moves);
    const auto bodies = std::count_if(scene.bodies.begin(), scene.bodies.end(),
                                      [&](const RigidBody& body) { return moves(scene.mass[body.node]); });
    const std::int64_t unknowns = 3 * (nodes + bodies);
    table_.row({std::string(large.kind), std::string(large.unit), large.size, unknowns, std::string(method),
                target, iterations, setup_s, wall_s, memory_mb, error, std::string(status),
                std::string(reason)});
  }

  Context& context_;
  Table table_;
  std::map<Key, std::map<std::string_view, double>> seconds_;
  Worst apart_;
};

}  // namespace

void large_scenes(Context& context) {
  const std::vector<int> solids = context.full() ? std::vector{44, 64} : std::vector{16, 24};
  const std::vector<int> sheets = context.full() ? std::vector{100, 250, 500} : std::vector{20, 40};
  const std::vector<int> longest = context.full() ? std::vector{136} : std::vector<int>{};  // half an hour
  context.begin(2 * std::ssize(solids) + 2 * std::ssize(sheets) + 2 * std::ssize(longest) + 1);
  Costing costing(context);
  for (const int cells : solids) costing.contest(solid(cells));
  for (const int cells : sheets) costing.contest(sheet(cells));
  costing.solve(columns(context.full() ? 50 : 10));
  for (const int cells : longest) costing.contest(solid(cells));

  context.verdict(Basis::code, "large.alike", "both methods end at the same places",
                  "largest distance of Newton's end from quasi_newton's, relative", costing.apart(),
                  0.1 * large_targets[1]);
  if (context.full())
    for (const double target : large_targets) {
      const std::string by = fmt::format(" to an error of {:g}", target),
                        what = "ratio of its time to newton's";
      context.verdict(
          Basis::goal, fmt::format("large.solids.{:g}", target),
          "quasi_newton takes at most half the time of Newton's method on 3e4 and 1e5 tetrahedra" + by,
          "largest " + what, costing.ratio("solid", 30000, 100000, target), 0.5);
      context.verdict(
          Basis::goal, fmt::format("large.cloth.{:g}", target),
          "quasi_newton takes at most half the time of Newton's method on cloth of 100 x 100 cells" + by,
          what, costing.ratio("cloth", 10000, 10000, target), 0.5);
    }
  costing.close();
}

}  // namespace pbdcheck
