// Where does each outer iteration find the step, over step and mass ratio of a swinging chain and over step
// and stiffness of a cantilever? And does the solver predict where the plain one converges?
#include <cmath>

#include <fmt/format.h>

#include "harness/measure.h"
#include "linear/linear_names.h"
#include "scenes/standard.h"
#include "studies/experiments.h"
#include "studies/iteration/stability_cells.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr std::string_view relaxation = "direct";

/// Of 3/8 cells^3 tetrahedra.
template <int cells, Strain strain>
Case stiff_cantilever(double young, double h) {
  return {
      fmt::format("cantilever{} {} E={:g} Pa", cells, strain_names[static_cast<std::size_t>(strain)], young),
      cantilever(cells, {young, 0.3}, strain), h};
}

StabilityMap stability_of_chain(bool full) {
  return {"chain20", "mass_ratio", chain_ratios(full), chain_steps(full), swinging_chain};
}

StabilityMap rods_map(bool full) {
  return {"rods10", "mass_ratio", full ? chain_ratios(false) : std::vector<double>{1, 30, 1000},
          chain_steps(full), swinging_rods};
}

std::vector<double> stiffnesses() {
  return {1e4, 1e5, 1e6, 1e7, 1e8, 1e9};  // Pa
}

StabilityMap cantilever_map(bool full) {
  std::vector<double> steps{1.0 / 30, 1.0 / 120, 1.0 / 480};
  if (full) steps = {1.0 / 30, 1.0 / 60, 1.0 / 120, 1.0 / 240, 1.0 / 480};
  return {"cantilever", "young_pa", stiffnesses(), steps, stiff_cantilever<8, Strain::corotational>};
}

/// Green and corotational, in two sizes.
std::vector<StabilityMap> larger_maps() {
  const std::vector<double> steps{1.0 / 30, 1.0 / 120, 1.0 / 480};
  const auto map = [&](const char* scene, auto make) {
    return StabilityMap{scene, "young_pa", stiffnesses(), steps, make};
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
  iterative.relaxation = "nesterov_jacobi";
  iterative.tolerance = 1e-10;
  iterative.max_outer = 100;
  iterative.max_sweeps = 1000;
  return {automatic, iterative};
}

Table map_table(Context& context, const std::string& name, const std::string& value_column) {
  return context.table(name, {"scene", "step_s", value_column, "integrator", "outer", "relaxation", "memory",
                              "predicted_contraction", "iterations", "error_final", "outer_iterations",
                              "sweeps", "status", "reason"});
}

void write_map(Table& table, const StabilityMap& map, const std::vector<MapCell>& cells) {
  for (const auto& cell : cells)
    for (const auto& [method, iterations, error, report, status, reason] : cell.solves)
      table.row({map.scene, cell.step.h, cell.value, method.integrator, method.outer, method.relaxation,
                 std::int64_t{method.memory}, report.contraction, iterations, error,
                 std::int64_t{report.outer_iterations}, report.sweeps, status, reason});
}

void auto_verdict(Context& context, const std::vector<const MapCell*>& all) {
  Worst worst;
  for (const MapCell* cell : all) worst.add(solve_by_auto(*cell).error);
  context.verdict(Basis::code, "stability.auto", "auto finds the step in every cell of all maps",
                  "largest error", worst.value(), 1e-10);
}

/// Solids of two sizes and strains, in the full tier.
void cantilevers(Context& context) {
  Table table = map_table(context, "cantilevers", "young_pa");
  Worst worst;
  for (const StabilityMap& map : larger_maps()) {
    const auto cells = run_map(context, map, contenders());
    write_map(table, map, cells);
    for (const MapCell& cell : cells) worst.add(solve_by_auto(cell).error);
    context.advance(map.scene);
  }
  table.close();
  context.verdict(
      Basis::code, "stability.auto_cantilevers",
      "auto finds the step of every cantilever, green and corotational, of 192 and 1536 tetrahedra",
      "largest error", worst.value(), 1e-10);
}

}  // namespace

std::vector<Case> stability_map_cases(bool full) {
  std::vector<Case> all;
  std::vector<StabilityMap> maps{stability_of_chain(full), rods_map(full), cantilever_map(full)};
  if (full)
    for (StabilityMap& map : larger_maps()) maps.push_back(std::move(map));
  for (const auto& map : maps)
    for (const double value : map.values)
      for (const double h : map.steps) all.push_back(map.make(value, h));
  return all;
}

void stability_map(Context& context) {
  context.begin(context.full() ? 5 + std::ssize(larger_maps()) : 5);
  std::vector<std::vector<MapCell>> found;
  for (const StabilityMap& map :
       {stability_of_chain(context.full()), rods_map(context.full()), cantilever_map(context.full())}) {
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
