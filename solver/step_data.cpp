#include "step_data.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "error.h"
#include "names.h"

namespace pbd {
StepData::StepData(const Scene& scene, const Method& method)
    : integrator(find_named(integrators(), "integrator", method.integrator)),
      outer(find_named(outers(), "outer", method.outer)),
      relaxation(make_relaxation(method.relaxation)),
      rows(allocate_rows(scene, effect_of_block, integrator.explicit_forces)),
      contacts(scene, friction_by_name(method.friction), rows, effect_of_block),
      bodies(scene),
      inverse_mass(rows.inverse_mass),
      zero(Points::Zero(3, bodies.columns())),
      seconds(rows.blocks.size(), 0.0),
      inertia(rows.inverse_mass.size(), 0.0),
      own_inertia(inertia),
      anderson(method.memory),
      quasi_newton(method.memory),
      krylov(most_krylov + 1, zero),
      turned_x(zero),
      push(zero) {
  kept.reserve(static_cast<std::size_t>(2 * row_count(rows)));
  for (const double mass : scene.mass)
    if (std::isfinite(mass)) finite_mass += mass;
  if (finite_mass == 0) finite_mass = 1;  // nothing moves, and an unmet constraint still weighs
  for (std::size_t b = 0; b < rows.blocks.size(); ++b)
    costs.push_back(
        {std::visit([](const auto& effect) { return effect.name; }, scene.effects[effect_of_block[b]]),
         row_count(rows.blocks[b]),
         std::visit([](const auto& block) { return block.bytes(); }, rows.blocks[b]), 0.0});
  find_free_components();
  for (const Effect& effect : scene.effects)
    if (const auto* gyroscopic = std::get_if<Gyroscopic>(&effect))
      implicit_gyroscopic = gyroscopic->implicit && !integrator.explicit_forces;
  hard_constraints = !std::all_of(scene.effects.begin(), scene.effects.end(), all_compliant);
  const bool gradient_at_x = method.direction_blend == 1 && !integrator.explicit_forces;
  if (outer.potential == OnPotential::always && !gradient_at_x)
    throw SetupError("outer", std::string(outer.name) + " with directions that are not those at x",
                     "direction_blend 1 and an implicit integrator, or another outer iteration");
  for (const std::size_t index : effect_of_block)
    eliminated.push_back(outer.potential != OnPotential::never && all_compliant(scene.effects[index]) &&
                         !of_bodies(scene.effects[index]) &&
                         !std::holds_alternative<Contact>(scene.effects[index]));
  on_potential = !eliminated.empty() && gradient_at_x && bodies.count() == 0 &&
                 std::all_of(eliminated.begin(), eliminated.end(), [](bool own) { return own; });
  for (const std::size_t index : effect_of_block)
    if (outer.potential == OnPotential::where_possible && !fills_space(scene.effects[index]))
      on_potential = false;
  in_metric = outer.potential == OnPotential::always && !on_potential;
  if (in_metric)
    for_each_block(rows.blocks, [&](const auto& block) {
      if (block.bounded())
        throw SetupError("outer", std::string(outer.name) + " with limits or motors of limited force",
                         "another outer iteration");
    });
  if (!contacts.listed()) return;
  if (in_metric)
    throw SetupError("outer", std::string(outer.name) + " with contact", "another outer iteration");
  if (!integrator.contact)
    throw SetupError("integrator", std::string(integrator.name) + " with contact",
                     "implicit_euler, newmark by alpha or symplectic_euler");
  if (method.beta && method.gamma)
    throw SetupError("beta", "Newmark's own family with contact", "newmark by alpha");
}

void StepData::begin(const Scene& scene, const Method& method, double h, const State& state) {
  make_map(scene, method, h, state);
  begin_damping(scene, state.time);
  if (contacts.listed()) {
    contacts.find(scene, bodies, {start_x, start_poses, state.time}, start_v, map, method.warm_start,
                  inverse_mass, rows);
    for (std::size_t b = 0; b < rows.blocks.size(); ++b)
      if (contacts.owns(b)) {
        costs[b].rows = row_count(rows.blocks[b]);
        costs[b].bytes = std::visit([](const auto& block) { return block.bytes(); }, rows.blocks[b]);
      }
  }
  if (!method.warm_start) forget_impulses();
  v = start_v;
  previous = v;
  direction_blend = integrator.explicit_forces ? 0 : method.direction_blend;
  if (direction_blend != 1) {
    contraction = 0;  // until the iterates show otherwise
  }
  anderson.forget();
  accelerated = false;
  quasi_newton.forget();
  evaluated = false;
  slow_changes = 0;
  best_residual = infinity;
  since_factor = 0;
  heavier = false;
  if (on_potential || in_metric) {
    if (!quasi_newton.metric().factored_for(map)) factor_metric(scene, MetricShape::rest);
    turn_metric(scene, map.x0 + map.d * v);
  }
}

void StepData::keep_if_best(int outer_iteration, double residual) {
  constexpr int first_kept = 10;  // a step that is easy ends before
  if (outer_iteration < first_kept || !(residual < best_residual)) return;
  best_residual = residual;
  best_v = v;
  keep_impulses_and_biases(rows, best_rows);
}

bool StepData::return_to_best(double residual) {
  if (!(best_residual < residual)) return false;
  v = best_v;
  restore_impulses_and_biases(best_rows, rows);
  evaluated = false;
  return true;
}

bool StepData::widen_contacts(const Scene& scene) {
  if (!contacts.listed()) return false;
  if (!contacts.widen(scene, bodies, {start_x, start_poses, x_time}, x, map, rows)) return false;
  anderson.forget();
  accelerated = false;
  best_residual = infinity;
  return true;
}

double StepData::distance(const Points& a, const Points& b) const {
  double squared = 0;
  for (std::size_t node = 0; node < inverse_mass.size(); ++node)
    if (inverse_mass[node] > 0)
      squared +=
          (a.col(static_cast<int>(node)) - b.col(static_cast<int>(node))).squaredNorm() / inverse_mass[node];
  return std::sqrt(squared);
}

double StepData::inner_product(const Points& a, const Points& b) const {
  double sum = 0;
  for (std::size_t node = 0; node < inverse_mass.size(); ++node)
    if (inverse_mass[node] > 0)
      sum += a.col(static_cast<int>(node)).dot(b.col(static_cast<int>(node))) / inverse_mass[node];
  return sum;
}

BlockResidual StepData::linearise_at(const Scene& scene, const Points& at) {
  x = map.x0 + map.d * at;
  const Configuration here = placed(x, poses, x_time);
  const Configuration* const where = directions_for(x);
  rows.inverse_mass = inverse_mass;
  BlockResidual sums;
  for (std::size_t b = 0; b < rows.blocks.size(); ++b) {
    const auto start = std::chrono::steady_clock::now();
    const BlockResidual share = contacts.owns(b)
                                    ? contacts.linearise(here, where, map, at, rows.inverse_mass, b, rows)
                                    : linearise(scene.effects[effect_of_block[b]], map, here, at,
                                                rows.inverse_mass, finite_mass, rows.blocks[b], where);
    sums += share;
    costs[b].seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  rebuilt = map.v_free;
  apply_impulses(rows, rebuilt);
  torque_missed = add_gyroscopic(rebuilt);
  return sums;
}

double StepData::bound_contraction(const Scene& scene, int sign) {
  std::fill(inertia.begin(), inertia.end(), 0.0);
  const Configuration here{x, poses, x_time};
  const auto bound_of = [&](const std::vector<double>& kg) {
    double largest = 0;
    for (std::size_t node = 0; node < kg.size(); ++node)
      largest = std::max(largest, 2 * kg[node] * inverse_mass[node]);
    return largest;
  };
  for (std::size_t b = 0; b < rows.blocks.size(); ++b) {
    std::fill(own_inertia.begin(), own_inertia.end(), 0.0);
    if (contacts.owns(b))
      contacts.add_geometric_inertia(map, here, sign * direction_blend, rows, b, own_inertia);
    else
      add_geometric_inertia(scene.effects[effect_of_block[b]], map, here, sign * direction_blend,
                            rows.blocks[b], own_inertia);
    costs[b].contraction = std::max(sign < 0 ? costs[b].contraction : 0.0, bound_of(own_inertia));
    for (std::size_t node = 0; node < inertia.size(); ++node) inertia[node] += own_inertia[node];
  }
  double bound = bound_of(inertia);
  if (bodies.count() > 0) bound += bodies.contraction(v, map.d, map.s, implicit_gyroscopic);
  return bound;
}

void StepData::add_inertia() {
  if (std::all_of(inertia.begin(), inertia.end(), [](double kg) { return kg == 0; })) return;
  heavier = true;
  rebuilt = map.v_free;
  for (std::size_t node = 0; node < inertia.size(); ++node) {
    const double share = inertia[node] * inverse_mass[node];  // D / M
    const auto column = static_cast<Eigen::Index>(node);
    rows.inverse_mass[node] = inverse_mass[node] / (1 + share);
    rebuilt.col(column) = (map.v_free.col(column) + share * v.col(column)) / (1 + share);
  }
  refresh_inverse_diagonal(rows);
  apply_impulses(rows, rebuilt);
  add_gyroscopic(rebuilt);
}

std::int64_t StepData::relax(bool fresh, const InnerBudget& budget) {
  std::fill(seconds.begin(), seconds.end(), 0.0);
  const auto sweeps = pbd::relax(relaxation, rows, v, fresh, budget, &seconds);
  for (std::size_t b = 0; b < seconds.size(); ++b)
    costs[b].seconds += seconds[b] * static_cast<double>(sweeps);
  return sweeps;
}

/// What one plain iteration makes of a small error at v, with the rows linearised at v: the impulses push
/// along turned directions, and the rows miss what their value does beyond J.
std::int64_t StepData::apply_plain(const Scene& scene, Points& error) {
  constexpr double turned = 1e-6;  // of the scene's extent
  const double extent = std::max((map.x0.rowwise().maxCoeff() - map.x0.rowwise().minCoeff()).maxCoeff(),
                                 bodies.largest_radius());
  const double scale = turned * extent / (map.d * error.colwise().norm().maxCoeff());
  turned_x = map.x0 + map.d * (v + scale * error);
  const Configuration turned_here = placed(turned_x, other_poses, x_time);
  const Configuration* const where = directions_for(turned_x);
  push = map.v_free;
  keep_impulses_and_biases(rows, kept);
  for (std::size_t b = 0; b < rows.blocks.size(); ++b)
    if (contacts.owns(b))
      contacts.perturb(map, turned_here, v, scale, error, inverse_mass, b, rows, push);
    else
      perturb(scene.effects[effect_of_block[b]], map, turned_here, v, scale, error, inverse_mass,
              rows.blocks[b], push, where);
  add_gyroscopic(push);
  error = (push - rebuilt) / scale;
  constexpr InnerBudget rough{.max_sweeps = 200, .relative = 1e-2};
  const std::int64_t sweeps = pbd::relax(relaxation, rows, error, true, rough, nullptr);
  restore_impulses_and_biases(kept, rows);
  return sweeps;
}

std::int64_t StepData::estimate_contraction(const Scene& scene) {
  if (direction_blend != 1) {
    forget_prediction();
    return 0;
  }
  const double tension = bound_contraction(scene, 1);
  contraction = std::max(tension, bound_contraction(scene, -1));
  if (on_potential || in_metric || !(contraction > slow_contraction)) return 0;
  constexpr int most = most_krylov, fewest = 3;  // vectors, in the first step and later ones
  using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most, most>;
  const int count = mode_known ? fewest : most;
  if (!mode_known) {
    for (Eigen::Index k = 0; k < v.size(); ++k)
      krylov[0].reshaped()[k] = irregular(static_cast<std::size_t>(k) + 1);
    for (std::size_t node = 0; node < inverse_mass.size(); ++node)
      if (!(inverse_mass[node] > 0)) krylov[0].col(static_cast<Eigen::Index>(node)).setZero();
    krylov[0] /= norm(krylov[0]);
  }
  std::int64_t sweeps = 0;
  Small projected = Small::Zero(count, count);
  int used = 0;
  for (; used < count; ++used) {
    auto& next = krylov[static_cast<std::size_t>(used) + 1];
    next = krylov[static_cast<std::size_t>(used)];
    sweeps += apply_plain(scene, next);
    const double before = norm(next);
    for (int k = 0; k <= used; ++k) {
      projected(k, used) = inner_product(krylov[static_cast<std::size_t>(k)], next);
      next -= projected(k, used) * krylov[static_cast<std::size_t>(k)];
    }
    const double left = norm(next);
    constexpr double exhausted = 1e-10;
    if (!(left > exhausted * before)) {
      ++used;
      break;
    }
    next /= left;
    if (used + 1 < count) projected(used + 1, used) = left;
  }
  const Eigen::EigenSolver<Small> ritz(Small(projected.topLeftCorner(used, used)));
  int largest = 0;
  const double estimate = ritz.eigenvalues().cwiseAbs().maxCoeff(&largest);
  if (!std::isfinite(estimate)) {
    forget_prediction();
    return sweeps;
  }
  contraction = std::min(contraction, estimate);
  Points& mode = krylov.back();
  mode.setZero();
  for (int k = 0; k < used; ++k)
    mode += ritz.eigenvectors()(k, largest).real() * krylov[static_cast<std::size_t>(k)];
  krylov[0] = mode / norm(mode);
  mode_known = true;
  return sweeps;
}

void StepData::forget_prediction() {
  contraction = std::nan("");
  mode_known = false;
}

void StepData::forget_impulses() {
  for_each_block(rows.blocks, [](auto& block) {
    for (auto& impulse : block.impulse) impulse.setZero();
  });
}

}  // namespace pbd
