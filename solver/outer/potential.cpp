#include "outer/potential.h"

#include <chrono>
#include <cmath>

namespace pbd {

void weigh(const std::vector<double>& inverse_mass, Points& v, int threads) {
  each_columns(threads, v.cols(), [&](Eigen::Index first, Eigen::Index count) {
    for (Eigen::Index node = first; node < first + count; ++node)
      v.col(node) *= inverse_mass[node] > 0 ? 1 / inverse_mass[node] : 0.0;
  });
}

RowResidual Potential::evaluate(StepSystem& system) {
  const Problem& problem = system.problem;
  CurrentIterate& at = system.at;
  const int threads = system.rows.threads;
  at.x.resizeLike(at.v);
  at.rebuilt.resizeLike(at.v);
  each_columns(threads, at.v.cols(), [&](Eigen::Index first, Eigen::Index count) {
    at.x.middleCols(first, count) =
        problem.map.x0.middleCols(first, count) + problem.map.d * at.v.middleCols(first, count);
    at.rebuilt.middleCols(first, count) = problem.map.v_free.middleCols(first, count);
  });
  const Configuration here = placed(problem, at.x, at.poses, problem.x_time);
  system.rows.inverse_mass = problem.inverse_mass;
  value = std::pow(mass_distance(problem.inverse_mass, at.v, problem.map.v_free, threads), 2) / 2;
  const RowPlace place{problem.map, here, nullptr, at.v, problem.inverse_mass, problem.finite_mass};
  RowResidual sums;
  for (Slot& slot : system.slots) {
    const auto start = std::chrono::steady_clock::now();
    if (slot.eliminated)
      slot.source->add_potential(problem.map, at.x, problem.inverse_mass, slot.blocks(system.rows),
                                 at.rebuilt, value);
    else
      slot.source->linearise(place, slot.blocks(system.rows), sums);
    slot.cost.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  gradient.resizeLike(at.v);
  each_columns(threads, at.v.cols(), [&](Eigen::Index first, Eigen::Index count) {
    gradient.middleCols(first, count) = at.v.middleCols(first, count) - at.rebuilt.middleCols(first, count);
  });
  const Bodies& bodies = problem.bodies;
  for (int b = 0; b < bodies.count() && problem.implicit_gyroscopic; ++b)
    gradient.col(bodies.column(b)) -= problem.map.s * bodies.gyroscopic(b, at.v.col(bodies.column(b)));
  weigh(problem.inverse_mass, gradient, threads);
  apply_impulses(system.rows, at.rebuilt, eliminated);
  at.torque_missed = add_gyroscopic(system, at.rebuilt);
  return sums;
}

void Potential::begin_metric(StepSystem& system) {
  const Problem& problem = system.problem;
  if (!metric.factored_for(problem.map)) factor_metric(system, MetricShape::rest);
  system.at.x = problem.map.x0 + problem.map.d * system.at.v;
  deformation_.assign(problem.inverse_mass.size(), Eigen::Matrix3d::Zero());
  for (const Slot& slot : system.slots)
    slot.source->add_deformation(system.at.x, slot.view(system.rows), deformation_);
  metric.turn(deformation_);
}

void Potential::factor_metric(StepSystem& system, MetricShape shape) {
  const Problem& problem = system.problem;
  const Points& x = shape == MetricShape::rest ? problem.scene.initial.x : system.at.x;
  std::vector<MetricEntry> entries;
  for (Slot& slot : system.slots)
    if (slot.eliminated) slot.source->add_metric(problem.map, x, shape, slot.blocks(system.rows), entries);
  deformation_.assign(problem.inverse_mass.size(), Eigen::Matrix3d::Zero());
  if (shape != MetricShape::rest)
    for (const Slot& slot : system.slots)
      slot.source->add_deformation(system.at.x, slot.view(system.rows), deformation_);
  if (!metric.factor(problem.map, problem.inverse_mass, entries, deformation_, shape))
    return factor_metric(system, MetricShape::convex);
  metric.threads = system.rows.threads;
  since_factor = 0;
}

}  // namespace pbd
