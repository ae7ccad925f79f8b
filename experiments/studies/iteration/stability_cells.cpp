#include "studies/iteration/stability_cells.h"

#include <algorithm>

#include "error.h"
#include "harness/judges.h"
#include "harness/measure.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr double reached = 1e-8;  // error that iterations are counted to

MapSolve solve_cell(const Case& each, const State& start, const Points& exact, const Method& method) {
  MapSolve found{.method = method};
  try {
    const Trace trace = measure_once(each.scene, start, each.h, method, exact);
    const auto first = std::find_if(trace.points.begin(), trace.points.end(),
                                    [](const TracePoint& point) { return point.error <= reached; });
    if (first != trace.points.end()) found.iterations = first->outer_iterations;
    found.error = trace.points.back().error;
    found.report = trace.report;
    found.status = status_names[static_cast<std::size_t>(trace.report.status)];
    found.reason = trace.report.reason;
  } catch (const SetupError& refused) {
    found.status = "skipped";
    found.reason = refused.what();
  }
  return found;
}

}  // namespace

std::vector<MapCell> run_map(const Context& context, const StabilityMap& map,
                             const std::vector<Method>& all) {
  std::vector<MapCell> cells;
  for (const double value : map.values)
    for (const double h : map.steps)
      cells.push_back({{map.scene, map.value_column, value, map.make(value, h)}});
  context.parallel(std::ssize(cells), [&](std::int64_t index) {
    MapCell& cell = cells[static_cast<std::size_t>(index)];
    cell.start = start_of(cell.step);
    cell.exact = truth(cell.step.scene, cell.start, cell.step.h);
    const Points exact = places(cell.step.scene, cell.exact.x, cell.exact.orientation);
    for (const auto& method : all) cell.solves.push_back(solve_cell(cell.step, cell.start, exact, method));
  });
  return cells;
}

const MapSolve& solve_by_auto(const MapCell& cell) {
  return *std::find_if(cell.solves.begin(), cell.solves.end(),
                       [](const MapSolve& solve_cell) { return solve_cell.method.outer == "auto"; });
}

}  // namespace pbdcheck
