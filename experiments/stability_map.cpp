// Where does each outer iteration find the step, over step and mass ratio of a swinging chain and over step
// and stiffness of a cantilever? And does the solver predict where the plain one converges?
#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "auto_cost.h"
#include "contraction.h"
#include "error.h"
#include "experiments.h"
#include "judges.h"
#include "measure.h"
#include "measured_rate.h"
#include "relaxation.h"
#include "scenes/standard.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr double reached = 1e-8;  // error that iterations are counted to
constexpr std::string_view relaxation = "direct";

struct Map {
  std::string scene, value_column;
  std::vector<double> values, steps;
  Case (*make)(double value, double h);
};

/// Of 3/8 cells^3 tetrahedra.
template <int cells, Strain strain>
Case stiff_cantilever(double young, double h) {
  return {
      fmt::format("cantilever{} {} E={:g} Pa", cells, strain_names[static_cast<std::size_t>(strain)], young),
      cantilever(cells, {young, 0.3}, strain), h};
}

Map chain_map(bool full) {
  return {"chain20", "mass_ratio", chain_ratios(full), chain_steps(full), swinging_chain};
}

Map rods_map(bool full) {
  return {"rods10", "mass_ratio", full ? chain_ratios(false) : std::vector<double>{1, 30, 1000},
          chain_steps(full), swinging_rods};
}

std::vector<double> stiffnesses() {
  return {1e4, 1e5, 1e6, 1e7, 1e8, 1e9};  // Pa
}

Map cantilever_map(bool full) {
  std::vector<double> steps{1.0 / 30, 1.0 / 120, 1.0 / 480};
  if (full) steps = {1.0 / 30, 1.0 / 60, 1.0 / 120, 1.0 / 240, 1.0 / 480};
  return {"cantilever", "young_pa", stiffnesses(), steps, stiff_cantilever<8, Strain::corotational>};
}

/// Green and corotational, in two sizes.
std::vector<Map> larger_maps() {
  const std::vector<double> steps{1.0 / 30, 1.0 / 120, 1.0 / 480};
  const auto map = [&](const char* scene, auto make) {
    return Map{scene, "young_pa", stiffnesses(), steps, make};
  };
  return {map("cantilever192 corotational", stiff_cantilever<8, Strain::corotational>),
          map("cantilever192 green", stiff_cantilever<8, Strain::green>),
          map("cantilever1536 corotational", stiff_cantilever<16, Strain::corotational>),
          map("cantilever1536 green", stiff_cantilever<16, Strain::green>)};
}

std::vector<Method> methods(bool full) {
  std::vector<Method> all;
  for (const auto& [outer, memory] : {std::pair{"plain", 20},
                                      {"proximal", 0},
                                      {"proximal", 20},
                                      {"quasi_newton", 20},
                                      {"auto", 20},
                                      {"incremental", 20},
                                      {"frozen", 20}}) {
    Method method;
    method.outer = outer;
    method.memory = memory;
    method.relaxation = relaxation;
    method.tolerance = 1e-12;
    method.max_outer = full ? 1000 : 200;
    all.push_back(method);
  }
  return all;
}

/// `auto`, and an iterative relaxation that may spend 1e5 sweeps on the step's rows.
std::vector<Method> contenders() {
  Method automatic;
  automatic.relaxation = relaxation;
  automatic.tolerance = 1e-12;
  automatic.max_outer = 1000;
  Method iterative;
  iterative.outer = "proximal";
  iterative.relaxation = NesterovJacobi::name;
  iterative.tolerance = 1e-10;
  iterative.max_outer = 100;
  iterative.max_sweeps = 1000;
  return {automatic, iterative};
}

struct Solve {
  Method method;
  double iterations = std::nan("");  // until the error is first `reached`
  double error = std::nan("");       // at the step's end
  Report report{};
  std::string status{}, reason{};
};

Solve solve(const Case& each, const State& start, const Points& exact, const Method& method) {
  Solve found{.method = method};
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

struct MapCell : SolvedStep {
  std::vector<Solve> solves{};
};

std::vector<MapCell> run_map(const Context& context, const Map& map, const std::vector<Method>& all) {
  std::vector<MapCell> cells;
  for (const double value : map.values)
    for (const double h : map.steps)
      cells.push_back({{map.scene, map.value_column, value, map.make(value, h)}});
  context.parallel(std::ssize(cells), [&](std::int64_t index) {
    MapCell& cell = cells[static_cast<std::size_t>(index)];
    cell.start = start_of(cell.step);
    cell.exact = truth(cell.step.scene, cell.start, cell.step.h);
    const Points exact = places(cell.step.scene, cell.exact.x, cell.exact.orientation);
    for (const auto& method : all) cell.solves.push_back(solve(cell.step, cell.start, exact, method));
  });
  return cells;
}

Table map_table(Context& context, const std::string& name, const std::string& value_column) {
  return context.table(name, {"scene", "step_s", value_column, "integrator", "outer", "relaxation", "memory",
                              "predicted_contraction", "iterations", "error_final", "outer_iterations",
                              "sweeps", "status", "reason"});
}

void write_map(Table& table, const Map& map, const std::vector<MapCell>& cells) {
  for (const auto& cell : cells)
    for (const auto& [method, iterations, error, report, status, reason] : cell.solves)
      table.row({map.scene, cell.step.h, cell.value, method.integrator, method.outer, method.relaxation,
                 std::int64_t{method.memory}, report.contraction, iterations, error,
                 std::int64_t{report.outer_iterations}, report.sweeps, status, reason});
}

const Solve& solve_by_auto(const MapCell& cell) {
  return *std::find_if(cell.solves.begin(), cell.solves.end(),
                       [](const Solve& solve) { return solve.method.outer == "auto"; });
}

void auto_verdict(Context& context, const std::vector<const MapCell*>& all) {
  Worst worst;
  for (const MapCell* cell : all) worst.add(solve_by_auto(*cell).error);
  context.verdict("stability.auto", "auto finds the step in every cell of all maps", "largest error",
                  worst.value(), 1e-10);
}

/// Solids of two sizes and strains, in the full tier.
void cantilevers(Context& context) {
  Table table = map_table(context, "cantilevers", "young_pa");
  Worst worst;
  for (const Map& map : larger_maps()) {
    const auto cells = run_map(context, map, contenders());
    write_map(table, map, cells);
    for (const MapCell& cell : cells) worst.add(solve_by_auto(cell).error);
    context.advance(map.scene);
  }
  table.close();
  context.verdict(
      "stability.auto_cantilevers",
      "auto finds the step of every cantilever, green and corotational, of 192 and 1536 tetrahedra",
      "largest error", worst.value(), 1e-10);
}

struct Prediction {
  double radius = 0;     // of the dense matrices
  double predicted = 0;  // by the solver, at the end of the step by auto
  bool returns = false;  // plain does to the solution, from beside it

  /// NaN agrees with nothing.
  bool agrees() const { return returns ? predicted < 1 : predicted >= 1; }
};

std::vector<Prediction> predictions(const Context& context, const std::vector<MapCell>& cells) {
  std::vector<Prediction> all(cells.size());
  context.parallel(std::ssize(cells), [&](std::int64_t index) {
    const auto& cell = cells[static_cast<std::size_t>(index)];
    const auto& [name, scene, h, lead, lead_steps] = cell.step;
    const auto dense = reference::plain_contraction(scene, cell.exact.x, cell.exact.multiplier, h);
    all[static_cast<std::size_t>(index)] = {dense.radius(), solve_by_auto(cell).report.contraction,
                                            plain_returns(scene, cell.start, h, cell.exact, 1000)};
  });
  return all;
}

void prediction_verdicts(Context& context, const std::vector<MapCell>& cells) {
  constexpr double undecided = 0.05, worth_estimating = 0.7;
  const auto all = predictions(context, cells);
  Table table = context.table("predictions", {"scene", "step_s", "mass_ratio", "predicted_rate",
                                              "predicted_contraction", "behaviour"});
  Worst rate;
  double decided = 0, wrong = 0;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const Prediction& found = all[k];
    table.row({"chain20", cells[k].step.h, cells[k].value, found.radius, found.predicted,
               found.returns ? "converged" : "oscillating"});
    if (std::abs(found.radius - 1) > undecided) ++decided, wrong += found.agrees() ? 0 : 1;
    if (found.radius > worth_estimating) rate.add(std::abs(found.predicted / found.radius - 1));
  }
  context.verdict("stability.predicted_convergence",
                  "predicted and measured convergence of plain agree where the radius is not within 5 % of 1",
                  "share of cells of the chain's map where they do not", wrong / decided, 0.01);
  context.verdict("stability.predicted_rate",
                  "the solver's prediction equals the dense spectral radius where that exceeds 0.7",
                  "largest |predicted/radius - 1|", rate.value(), 0.05);
  table.close();
}

/// Of bodies no dense matrices are known: whether plain returns to the solution against what was predicted.
void joint_verdict(Context& context, const std::vector<MapCell>& cells) {
  constexpr double undecided = 0.05;
  std::vector<int> wrong(cells.size(), 0), decided(cells.size(), 0);
  context.parallel(std::ssize(cells), [&](std::int64_t index) {
    const auto k = static_cast<std::size_t>(index);
    const auto& cell = cells[k];
    const double predicted = solve_by_auto(cell).report.contraction;
    if (std::abs(predicted - 1) <= undecided) return;
    decided[k] = 1;
    const bool returns = plain_returns(cell.step.scene, cell.start, cell.step.h, cell.exact, 1000);
    wrong[k] = !(returns ? predicted < 1 : predicted >= 1);
  });
  context.verdict(
      "stability.predicted_joints",
      "predicted and measured convergence of plain agree on joints where the prediction is not "
      "within 5 % of 1",
      "share of cells of the rods' map where they do not",
      std::accumulate(wrong.begin(), wrong.end(), 0.0) / std::accumulate(decided.begin(), decided.end(), 0.0),
      0.01);
}

}  // namespace

std::vector<Case> stability_map_cases(bool full) {
  std::vector<Case> all;
  std::vector<Map> maps{chain_map(full), rods_map(full), cantilever_map(full)};
  if (full)
    for (Map& map : larger_maps()) maps.push_back(std::move(map));
  for (const auto& map : maps)
    for (const double value : map.values)
      for (const double h : map.steps) all.push_back(map.make(value, h));
  return all;
}

void stability_map(Context& context) {
  context.begin(context.full() ? 5 + std::ssize(larger_maps()) : 5);
  std::vector<std::vector<MapCell>> found;
  for (const Map& map :
       {chain_map(context.full()), rods_map(context.full()), cantilever_map(context.full())}) {
    found.push_back(run_map(context, map, methods(context.full())));
    Table table = map_table(context, map.scene, map.value_column);
    write_map(table, map, found.back());
    table.close();
    context.advance(map.scene);
  }
  std::vector<const MapCell*> all;
  std::vector<const SolvedStep*> steps;
  for (const auto& cells : found)
    for (const MapCell& cell : cells) all.push_back(&cell), steps.push_back(&cell);
  auto_verdict(context, all);
  prediction_verdicts(context, found[0]);
  joint_verdict(context, found[1]);
  context.advance("predictions");
  auto_cost(context, steps);
  context.advance("cost");
  if (context.full()) cantilevers(context);
}

}  // namespace pbdcheck
