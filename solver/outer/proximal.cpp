#include "outer/proximal.h"

#include <algorithm>

#include "rows/row_operations.h"

namespace pbd {

void Proximal::iterate(StepSystem& system, Progress& progress) {
  if (acceleration_.refuted(system, progress)) linearise_at(system, system.at.v);
  acceleration_.note(system);
  mass_.update(system, 1);
  add_mass(system);
  system.at.v = system.at.rebuilt;
  relax(system, progress);
  acceleration_.accelerate(system);
}

/// Replaces M by M + D and v_free by (M + D)^-1 (M v_free + D v), until the next linearisation.
void Proximal::add_mass(StepSystem& system) {
  const std::vector<double>& added = mass_.kg();
  if (std::all_of(added.begin(), added.end(), [](double kg) { return kg == 0; })) return;
  const Problem& problem = system.problem;
  CurrentIterate& at = system.at;
  heavier_ = true;
  at.rebuilt = problem.map.v_free;
  for (std::size_t node = 0; node < added.size(); ++node) {
    const double share = added[node] * problem.inverse_mass[node];  // D / M
    system.rows.inverse_mass[node] = problem.inverse_mass[node] / (1 + share);
    at.rebuilt.col(node) = (problem.map.v_free.col(node) + share * at.v.col(node)) / (1 + share);
  }
  refresh_inverse_diagonal(system.rows);
  apply_impulses(system.rows, at.rebuilt);
  add_gyroscopic(system, at.rebuilt);
}

}  // namespace pbd
