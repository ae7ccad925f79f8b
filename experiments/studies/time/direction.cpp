// What do directions at a step's begin, its end or between do to stability, constraints and energy, and what
// does velocity time stepping, which solves one linearisation? A small transverse motion y of a taut chain
// has y'' = -w^2 y of each mode, with the force at y_l + b (y_l+1 - y_l): the step's matrix has the
// determinant 1/D and the trace 1 + (1 - h^2 w^2)/D, D = 1 + b h^2 w^2. It is stable up to h = 2/(w sqrt(1 -
// 2 b)) if b < 1/2, else always, and leaves 1/D of the energy.
#include "studies/time/direction.h"

#include <cmath>

#include "studies/experiments.h"

namespace pbdcheck {
namespace {

std::vector<Cell> name_cells(const std::string& scene, const Scheme& scheme) {
  const pbd::Method& m = scheme.method;
  const double none = std::nan("");
  return {scene,
          scheme.family,
          m.integrator,
          m.outer,
          m.relaxation,
          m.direction_blend,
          m.outer == "frozen" ? m.stabilisation : none};
}
const std::vector<std::string> name_columns{"scene",      "family",          "integrator",   "outer",
                                            "relaxation", "direction_blend", "stabilisation"};

}  // namespace

std::vector<Scheme> default_schemes() {
  return joined(position_schemes("auto"), velocity_schemes());
}

Table direction_table(Context& context, std::string_view name, std::initializer_list<std::string> columns) {
  auto all = name_columns;
  all.insert(all.end(), columns);
  return context.table(name, all);
}

void add_row(Table& table, const std::string& scene, const Scheme& scheme, std::vector<Cell> values,
             const DirectionRun& run) {
  auto cells = name_cells(scene, scheme);
  cells.insert(cells.end(), values.begin(), values.end());
  cells.emplace_back(std::string(pbd::status_names[static_cast<std::size_t>(run.status)]));
  cells.emplace_back(run.reason);
  table.row(cells);
}

void direction(Context& context) {
  context.begin(6);
  direction_largest_steps(context);
  context.advance("largest steps");
  direction_modes(context);
  context.advance("modes");
  direction_energy(context);
  context.advance("energy");
  direction_equal_work(context);
  context.advance("equal work");
  direction_contact(context);
  context.advance("contact");
  direction_contenders(context);
  context.advance("contenders");
}

}  // namespace pbdcheck
