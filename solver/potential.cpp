// The part of a step's work that goes down the potential of eliminated rows (quasi_newton.h).
#include <chrono>
#include <cmath>

#include "step_data.h"

namespace pbd {

BlockResidual StepData::potential_at_v(const Scene& scene) {
  return evaluated ? BlockResidual{} : evaluate_potential(scene);
}

BlockResidual StepData::evaluate_potential(const Scene& scene) {
  x = map.x0 + map.d * v;
  const Configuration here = placed(x, poses, x_time);
  rows.inverse_mass = inverse_mass;
  rebuilt = map.v_free;
  potential = std::pow(distance(v, map.v_free), 2) / 2;
  BlockResidual sums;
  for (std::size_t b = 0; b < rows.blocks.size(); ++b) {
    const auto start = std::chrono::steady_clock::now();
    const Effect& effect = scene.effects[effect_of_block[b]];
    if (eliminated[b])
      potential += add_potential(effect, map, x, inverse_mass, rows.blocks[b], rebuilt);
    else
      sums += linearise(effect, map, here, v, inverse_mass, finite_mass, rows.blocks[b]);
    costs[b].seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  gradient = v - rebuilt;
  for (int b = 0; b < bodies.count() && implicit_gyroscopic; ++b)
    gradient.col(bodies.column(b)) -= map.s * bodies.gyroscopic(b, v.col(bodies.column(b)));
  for (std::size_t node = 0; node < inverse_mass.size(); ++node)
    gradient.col(node) *= inverse_mass[node] > 0 ? 1 / inverse_mass[node] : 0.0;
  apply_impulses(rows, rebuilt, eliminated);
  torque_missed = add_gyroscopic(rebuilt);
  evaluated = on_potential;
  return sums;
}

std::int64_t StepData::project(double accuracy, int most) {
  quasi_newton.metric().solve(gradient, direction);
  v -= direction;
  return hard_rows.solve(rows, eliminated, quasi_newton.metric(), accuracy, most, v);
}

void StepData::factor_metric(const Scene& scene, MetricShape shape) {
  std::vector<MetricEntry> entries;
  for (std::size_t b = 0; b < rows.blocks.size(); ++b)
    if (eliminated[b])
      add_metric(scene.effects[effect_of_block[b]], map, shape == MetricShape::rest ? scene.initial.x : x,
                 shape, rows.blocks[b], entries);
  deformation.assign(inverse_mass.size(), Eigen::Matrix3d::Zero());
  if (shape == MetricShape::current)
    for (const auto& effect : scene.effects) add_deformation(effect, x, deformation);
  quasi_newton.metric().factor(map, inverse_mass, entries, deformation);
  quasi_newton.forget();
  since_factor = 0;
}

void StepData::turn_metric(const Scene& scene, const Points& at) {
  deformation.assign(inverse_mass.size(), Eigen::Matrix3d::Zero());
  for (const auto& effect : scene.effects) add_deformation(effect, at, deformation);
  quasi_newton.metric().turn(deformation);
}

double StepData::find_direction() {
  const auto find = [this] {
    quasi_newton.direction(gradient, direction);
    slope = (gradient.array() * direction.array()).sum();
  };
  find();
  if (!(slope < 0)) {
    quasi_newton.forget();
    find();
  }
  return std::sqrt(-slope);
}

/// Goes where the potential is lowest: the old velocity, the free one or rest. Not above rest, a step gains
/// no energy but what the given forces bring: 1/2 |v - v_free|^2 + U <= 1/2 |v_free|^2 + U_old. True if it
/// moved.
bool StepData::start_low(const Scene& scene) {
  search_from = v;
  last_gradient = gradient;
  double lowest = potential;
  const Points* last = &search_from;
  for (const Points* start : {&map.v_free, &zero}) {
    if (start == &zero && lowest <= inner_product(map.v_free, map.v_free) / 2) break;
    v = *start;
    evaluate_potential(scene);
    if (potential < lowest) {
      lowest = potential;
      search_from = v;
      last_gradient = gradient;
      last = start;
    }
  }
  const bool moved = last != &search_from;
  if (moved && potential > lowest) {
    v = search_from;
    evaluate_potential(scene);
  }
  v = search_from;
  gradient = last_gradient;
  potential = lowest;
  return moved;
}

void StepData::descend(const Scene& scene, bool first) {
  constexpr double sufficient = 1e-4;
  constexpr double flat = 1e-10, flatter = 0.8;  // where the potential's change is lost in its rounding
  constexpr int most_halvings = 30;
  if (first) {
    if (start_low(scene)) return;
    find_direction();
  }
  constexpr int most_iterations = 30;
  if (++since_factor > most_iterations) {
    factor_metric(scene, MetricShape::current);
    find_direction();
  }
  const double before = potential;
  search_from = v;
  last_gradient = gradient;
  double length = 1;
  for (int k = 0; k < most_halvings; ++k, length /= 2) {
    v = search_from + length * direction;
    evaluate_potential(scene);
    const double along = (gradient.array() * direction.array()).sum();
    if (potential <= before + sufficient * length * slope ||
        (potential <= (1 + flat) * before && along <= flatter * std::abs(slope))) {
      quasi_newton.learn(v - search_from, gradient - last_gradient);
      return;
    }
  }
  v = search_from;
  evaluate_potential(scene);
  quasi_newton.forget();
}

BlockResidual StepData::settle(const Scene& scene, double accuracy) {
  search_from = v;
  linearise_at(scene, v);
  quasi_newton.solve_rows(accuracy, gradient, rows, v);
  evaluated = false;
  return linearise_at(scene, v);
}

void StepData::unsettle(const Scene& scene) {
  v = search_from;
  evaluate_potential(scene);
}

}  // namespace pbd
