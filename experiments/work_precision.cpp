// What accuracy costs: error against the judge over seconds, row updates and outer iterations, for every
// outer iteration and relaxation, over tolerance and step; the judges' and rivals' own times on the same
// axes.
#include <algorithm>
#include <cmath>

#include "error.h"
#include "experiments.h"
#include "judge.h"
#include "judges.h"
#include "measure.h"
#include "outer.h"
#include "relaxation.h"
#include "scenes/standard.h"

namespace pbdcheck {
namespace {

using namespace pbd;

void add_point(Table& table, const Case& each, std::string_view outer, std::string_view relaxation,
               double tolerance, const TracePoint& point, std::string_view status, std::string_view reason) {
  table.row({each.name, each.h, "implicit_euler", std::string(outer), std::string(relaxation), "", tolerance,
             std::int64_t{point.outer_iterations}, point.sweeps, point.row_updates, point.wall_s, point.error,
             std::string(status), std::string(reason)});
}

/// The judges' own times: the smallest of `timed_repeats` after a discarded run.
void judge_points(const Case& each, const State& start, const Points& exact, Table& table) {
  for (const auto& judge : reference::judges()) {
    judge.judge(each.scene, start, each.h);
    auto judged = judge.judge(each.scene, start, each.h);
    for (int repeat = 1; repeat < timed_repeats; ++repeat)
      judged.seconds = std::min(judged.seconds, judge.judge(each.scene, start, each.h).seconds);
    const TracePoint point{.outer_iterations = judged.iterations,
                           .wall_s = judged.seconds,
                           .error = relative_error(judged.x, exact, start.x),
                           .residual = judged.residual};
    add_point(table, each, "judge", judge.name, 0, point,
              reference::outcome_names[static_cast<std::size_t>(judged.outcome)], judged.reason);
  }
}

/// One row a tolerance by `solve`; the tighter ones are skipped where one was missed, all of them where the
/// scene does not allow the method.
void tolerance_points(const Case& each, std::string_view outer, std::string_view relaxation,
                      const std::function<Trace(double)>& solve, Table& table) {
  std::string skipped;
  for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    TracePoint point{.wall_s = std::nan(""), .error = std::nan("")};
    std::string_view status = "skipped";
    std::string reason = skipped;
    try {
      if (skipped.empty()) {
        const Trace trace = measure([&] { return solve(tolerance); });
        point = trace.points.back();
        status = status_names[static_cast<std::size_t>(trace.report.status)];
        reason = trace.report.reason;
        if (trace.report.status != Status::ok) skipped = "a looser tolerance was not reached";
      }
    } catch (const SetupError& error) {
      reason = skipped = error.what();
    }
    add_point(table, each, outer, relaxation, tolerance, point, status, reason);
  }
}

void method_points(const Case& each, const State& start, const Points& exact, const Outer& outer,
                   std::string_view relaxation, int max_outer, Table& table) {
  Method method;
  method.outer = outer.name;
  method.max_outer = max_outer;
  method.max_sweeps = std::min(method.max_sweeps, 4 * max_outer);  // so that hopeless ones end early
  if (outer.potential != OnPotential::always) method.relaxation = relaxation;
  const auto solve = [&](double tolerance) {
    method.tolerance = tolerance;
    return measure_once(each.scene, start, each.h, method, exact);
  };
  tolerance_points(each, outer.name, relaxation, solve, table);
}

void rival_points(const Case& each, const State& start, const Points& exact, int max_iterations,
                  Table& table) {
  for (const auto& rival : rivals::rivals()) {
    const auto solve = [&](double tolerance) {
      return measure_once(each.scene, start, each.h, rival, {tolerance, max_iterations}, exact);
    };
    tolerance_points(each, "rival", rival.name, solve, table);
  }
}

/// The relaxations that make a difference to an outer iteration.
std::vector<std::string_view> relaxations_for(const Outer& outer) {
  return outer.potential == OnPotential::always ? std::vector<std::string_view>{"none"} : relaxation_names();
}

}  // namespace

std::vector<Case> work_precision_cases(bool full) {
  constexpr double lead = 1.0 / 100;
  std::vector<Case> all;
  for (const double h : {1.0 / 240, 1.0 / 60}) {
    all.push_back({"chain20", chain(20), h, lead, 25});
    all.push_back({"chain20 tip x100", chain(20, 100), h, lead, 25});
    all.push_back({full ? "cloth20" : "cloth10", cloth(full ? 20 : 10), h, lead, 25});
    all.push_back({"cantilever E=1e5 Pa", cantilever(8, {1e5, 0.3}, Strain::green), h, lead, 10});
    all.push_back({"cantilever E=1e6 Pa", cantilever(8, {1e6, 0.3}, Strain::green), h, lead, 10});
  }
  return all;
}

void work_precision(Context& context) {
  const auto all = work_precision_cases(context.full());
  const int budget = context.full() ? 1000 : 50;  // outer iterations
  context.begin(std::ssize(all));
  Table table = context.table(
      "points", {"scene", "step_s", "integrator", "outer", "relaxation", "friction", "tolerance",
                 "outer_iterations", "sweeps", "row_updates", "wall_s", "error", "status", "reason"});
  for (const auto& each : all) {
    const State start = start_of(each);
    const Points exact = truth(each.scene, start, each.h).x;
    for (const auto& outer : outers())
      for (const auto& relaxation : relaxations_for(outer))
        method_points(each, start, exact, outer, relaxation, budget, table);
    rival_points(each, start, exact, budget, table);
    judge_points(each, start, exact, table);
    context.advance(each.name);
  }
  table.close();
}

}  // namespace pbdcheck
