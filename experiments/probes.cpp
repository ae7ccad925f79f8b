#include "probes.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>

#include "effects/effects.h"

namespace pbdcheck {
namespace {

/// Calls f(c, A) for every constraint of the effect; does nothing for a force.
template <class E, class F>
void for_each_constraint(const E& effect, const pbd::Points& at, F&& f) {
  if constexpr (pbd::RowEffect<E>) {
    using Constraint = pbd::Constraint<E>;
    typename Constraint::Positions x;
    typename Constraint::Value value;
    typename Constraint::Jacobian jacobian;
    for (std::size_t i = 0; i < effect.node.size(); ++i) {
      const auto nodes = Constraint::node(effect, i);
      for (int a = 0; a < Constraint::nodes; ++a) x.col(a) = at.col(nodes[static_cast<std::size_t>(a)]);
      Constraint::evaluate(effect, i, x, value, jacobian);
      f(value, Constraint::compliance(effect, i));
    }
  }
}

/// An infinite stiffness is a compliance of zero; no effect has both kinds of rows in one constraint.
bool is_hard(const auto& compliance) {
  return compliance.isZero(0);
}

template <class F>
void for_finite_nodes(const pbd::Scene& scene, F&& f) {
  for (int node = 0; node < scene.nodes(); ++node) {
    const double mass = scene.mass[static_cast<std::size_t>(node)];
    if (std::isfinite(mass)) f(node, mass);
  }
}

std::string_view error_unit(const pbd::Effect& effect) {
  if (std::holds_alternative<pbd::Anchor>(effect) || std::holds_alternative<pbd::Distance>(effect))
    return "_m";
  return std::holds_alternative<pbd::Bending>(effect) ? "_rad" : "";
}

bool has_rows(const pbd::Effect& effect) {
  return std::visit([]<class E>(const E&) { return pbd::RowEffect<E>; }, effect);
}

void append(std::vector<Cell>& row, const pbd::Vec3& vector) {
  for (int axis = 0; axis < 3; ++axis) row.emplace_back(vector[axis]);
}

void append_momentum(const pbd::Scene& scene, const pbd::State& state, std::vector<Cell>& row) {
  pbd::Vec3 linear = pbd::Vec3::Zero();
  pbd::Vec3 angular = pbd::Vec3::Zero();
  for_finite_nodes(scene, [&](int node, double mass) {
    const pbd::Vec3 momentum = mass * state.v.col(node);
    linear += momentum;
    angular += pbd::Vec3(state.x.col(node)).cross(momentum);
  });
  append(row, linear);
  append(row, angular);
}

std::vector<std::string> columns_of(const Probe& probe, const pbd::Scene& scene) {
  const std::string begin = probe.name.empty() ? "" : probe.name + "_";
  std::vector<std::string> columns;
  const auto per_axis = [&](std::string_view pattern) {
    for (const char axis : {'x', 'y', 'z'})
      columns.push_back(begin + fmt::format(fmt::runtime(pattern), axis));
  };
  if (probe.kind == "position") per_axis("{}_m");
  if (probe.kind == "velocity") per_axis("v{}_m_s");
  if (probe.kind == "energy")
    for (const auto* name : {"kinetic_energy_j", "gravity_energy_j", "elastic_energy_j"})
      columns.push_back(begin + name);
  if (probe.kind == "momentum") {
    per_axis("momentum_{}_kg_m_s");
    per_axis("angular_momentum_{}_kg_m2_s");
  }
  if (probe.kind == "constraint_error")
    for (std::size_t i = 0; i < scene.effects.size(); ++i)
      if (has_rows(scene.effects[i])) {
        const auto name = std::visit([](const auto& effect) { return effect.name; }, scene.effects[i]);
        columns.push_back(fmt::format("{}{}_{}_error{}", begin, name, i, error_unit(scene.effects[i])));
      }
  return columns;
}

}  // namespace

double kinetic_energy(const pbd::Scene& scene, const pbd::State& state) {
  double energy = 0;
  for_finite_nodes(scene,
                   [&](int node, double mass) { energy += mass / 2 * state.v.col(node).squaredNorm(); });
  return energy;
}

double gravity_energy(const pbd::Scene& scene, const pbd::State& state) {
  double energy = 0;
  for (const auto& effect : scene.effects)
    if (const auto* gravity = std::get_if<pbd::Gravity>(&effect))
      for_finite_nodes(scene, [&](int node, double mass) {
        energy -= mass * gravity->acceleration.dot(state.x.col(node));
      });
  return energy;
}

double elastic_energy(const pbd::Scene& scene, const pbd::State& state) {
  double energy = 0;
  for (const auto& effect : scene.effects)
    std::visit(
        [&](const auto& typed) {
          for_each_constraint(typed, state.x, [&](const auto& value, const auto& compliance) {
            if (!is_hard(compliance)) energy += value.dot(compliance.llt().solve(value)) / 2;
          });
        },
        effect);
  return energy;
}

double constraint_error(const pbd::Effect& effect, const pbd::State& state) {
  double largest = 0;
  std::visit(
      [&](const auto& typed) {
        for_each_constraint(typed, state.x, [&](const auto& value, const auto& compliance) {
          if (is_hard(compliance)) largest = std::max(largest, value.norm());
        });
      },
      effect);
  return largest;
}

std::vector<std::string> probe_columns(const std::vector<Probe>& probes, const pbd::Scene& scene) {
  std::vector<std::string> columns;
  for (const auto& probe : probes)
    for (auto& column : columns_of(probe, scene)) columns.push_back(std::move(column));
  return columns;
}

void append_probes(const std::vector<Probe>& probes, const pbd::Scene& scene, const pbd::State& state,
                   std::vector<Cell>& row) {
  for (const auto& probe : probes) {
    if (probe.kind == "position") append(row, state.x.col(probe.node));
    if (probe.kind == "velocity") append(row, state.v.col(probe.node));
    if (probe.kind == "energy")
      for (const auto energy : {kinetic_energy, gravity_energy, elastic_energy})
        row.emplace_back(energy(scene, state));
    if (probe.kind == "momentum") append_momentum(scene, state, row);
    if (probe.kind == "constraint_error")
      for (const auto& effect : scene.effects)
        if (has_rows(effect)) row.emplace_back(constraint_error(effect, state));
  }
}

}  // namespace pbdcheck
