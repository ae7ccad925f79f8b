#include "outer/step_system.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace pbd {

double inner_accuracy(const Method& method, Progress& progress) {
  constexpr double inner_share = 0.1;  // of the step's tolerance, left to the linear problem
  constexpr double good_fall = 0.5, tighter = 0.3, tightest = 1e-6;
  const double residual = progress.residual();
  progress.forcing = residual > good_fall * progress.relaxed_residual
                         ? std::max(tighter * progress.forcing, tightest * method.inner_tolerance)
                         : std::min(progress.forcing / tighter, method.inner_tolerance);
  progress.relaxed_residual = residual;
  return std::max(inner_share * method.tolerance * progress.scale, progress.forcing * residual);
}

Configuration placed(const Problem& problem, const Points& x, std::vector<Pose>& storage, double time) {
  problem.bodies.place(x, storage);
  return {x, storage, time};
}

const Configuration* directions_for(StepSystem& system, const Points& x) {
  const Problem& problem = system.problem;
  if (problem.direction_blend == 1) return nullptr;
  system.directions_x = problem.start_x + problem.direction_blend * (x - problem.start_x);
  system.directions.emplace(placed(problem, system.directions_x, system.direction_poses, problem.x_time));
  return &*system.directions;
}

RowResidual linearise_at(StepSystem& system, const Points& v) {
  const Problem& problem = system.problem;
  CurrentIterate& at = system.at;
  at.x = problem.map.x0 + problem.map.d * v;
  const Configuration here = placed(problem, at.x, at.poses, problem.x_time);
  const Configuration* const where = directions_for(system, at.x);
  system.rows.inverse_mass = problem.inverse_mass;
  const RowPlace place{problem.map, here, where, v, system.rows.inverse_mass, problem.finite_mass};
  RowResidual sums;
  for (Slot& slot : system.slots) {
    const auto start = std::chrono::steady_clock::now();
    slot.source->linearise(place, slot.blocks(system.rows), sums);
    slot.cost.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  at.rebuilt = problem.map.v_free;
  apply_impulses(system.rows, at.rebuilt);
  at.torque_missed = add_gyroscopic(system, at.rebuilt);
  return sums;
}

double add_gyroscopic(const StepSystem& system, Points& velocity) {
  const Problem& problem = system.problem;
  double missed = 0;
  if (!problem.implicit_gyroscopic) return missed;
  for (int b = 0; b < problem.bodies.count(); ++b) {
    const Eigen::Index column = problem.bodies.column(b);
    const double weight = system.rows.inverse_mass[column];  // of M, against M + D
    const double share = weight > 0 ? weight / problem.inverse_mass[column] : 0.0;
    Vec3 eta = velocity.col(column);
    const double left = problem.bodies.add_gyroscopic(b, share * problem.map.s, eta);
    if (weight > 0) missed += left * left / weight;
    velocity.col(column) = eta;
  }
  return missed;
}

void relax(StepSystem& system, Progress& progress) {
  const Method& method = system.problem.method;
  const InnerBudget budget{.max_sweeps = method.max_sweeps, .absolute = inner_accuracy(method, progress)};
  system.block_seconds.assign(system.rows.blocks.size(), 0.0);
  const bool first = std::exchange(progress.other_solver, false) || progress.iterations_of_rows == 0;
  const auto sweeps = relax(system.solver, system.rows, system.at.v, first, budget, &system.block_seconds);
  for (Slot& slot : system.slots)
    for (std::size_t b = slot.first; b < slot.first + slot.count; ++b)
      slot.cost.seconds += system.block_seconds[b] * static_cast<double>(sweeps);
  progress.linear_part = part(system.solver);
  progress.sweeps += sweeps;
  progress.row_updates += sweeps * row_count(system.rows);
}

}  // namespace pbd
