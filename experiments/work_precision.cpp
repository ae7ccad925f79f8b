// What accuracy costs: error against the judge over seconds, row updates and outer iterations, for every
// outer iteration and relaxation, over tolerance and step; the judges' own times on the same axes.
#include <algorithm>
#include <cmath>

#include "experiments.h"
#include "judge.h"
#include "judges.h"
#include "measure.h"
#include "names.h"
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

void method_points(const Case& each, const State& start, const Points& exact, std::string_view outer,
                   std::string_view relaxation, bool full, Table& table) {
  bool failed = false;
  for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    if (failed) {
      add_point(table, each, outer, relaxation, tolerance, {.wall_s = std::nan(""), .error = std::nan("")},
                "skipped", "a looser tolerance was not reached");
      continue;
    }
    Method method;
    method.outer = outer;
    method.relaxation = relaxation;
    method.tolerance = tolerance;
    method.max_outer = full ? 1000 : 200;
    method.max_sweeps = 20;
    method.inner_tolerance = 0.1;
    const Trace trace = measure(each.scene, start, each.h, method, exact);
    failed = trace.report.status != Status::ok;
    add_point(table, each, outer, relaxation, tolerance, trace.points.back(),
              status_names[static_cast<std::size_t>(trace.report.status)], trace.report.reason);
  }
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
  context.begin(std::ssize(all));
  Table table = context.table(
      "points", {"scene", "step_s", "integrator", "outer", "relaxation", "friction", "tolerance",
                 "outer_iterations", "sweeps", "row_updates", "wall_s", "error", "status", "reason"});
  for (const auto& each : all) {
    const State start = start_of(each);
    const Points exact = truth(each.scene, start, each.h).x;
    for (const auto& outer : names(outers()))
      for (const auto& relaxation : relaxation_names())
        method_points(each, start, exact, outer, relaxation, context.full(), table);
    judge_points(each, start, exact, table);
    context.advance(each.name);
  }
  table.close();
}

}  // namespace pbdcheck
