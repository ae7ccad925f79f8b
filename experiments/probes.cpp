#include "probes.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>

#include "effect_rows.h"

namespace pbdcheck {
namespace {

/// Calls f(c, A) for every constraint of the effect; does nothing for a force.
template <class E, class F>
void for_each_constraint(const pbd::Scene& scene, const E& effect, const pbd::Configuration& at, F&& f) {
  if constexpr (pbd::RowEffect<E>) {
    using Constraint = pbd::Constraint<E>;
    typename Constraint::Value value;
    typename Constraint::Jacobian jacobian;
    for (std::size_t i = 0; i < pbd::constraint_count(effect); ++i) {
      Constraint::evaluate(effect, i, pbd::local(effect, i, pbd::columns_of(scene, effect, i), at), value,
                           jacobian);
      f(value, Constraint::compliance(effect, i));
    }
  }
}

/// Calls f(c, A) for every constraint of all effects chosen.
template <class Effects, class F>
void for_each_constraint_of(const pbd::Scene& scene, const Effects& effects, const pbd::State& state, F&& f) {
  pbd::Bodies bodies(scene);
  pbd::Points x, v;
  std::vector<pbd::Pose> poses;
  bodies.begin(state, x, v);
  bodies.place(x, poses);
  const pbd::Configuration at{x, poses, state.time};
  for (const pbd::Effect& effect : effects)
    std::visit([&](const auto& typed) { for_each_constraint(scene, typed, at, f); }, effect);
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

template <class F>
void for_turning_bodies(const pbd::Scene& scene, F&& f) {
  for (int body = 0; body < static_cast<int>(scene.bodies.size()); ++body)
    if (const auto& inertia = scene.bodies[static_cast<std::size_t>(body)].inertia; inertia.allFinite())
      f(body, inertia);
}

/// Of the values of an effect, as columns end.
struct Unit {
  std::string_view operator()(const pbd::TriangleStrain&) const { return ""; }
  std::string_view operator()(const pbd::TetStrain&) const { return ""; }
  std::string_view operator()(const pbd::Bending&) const { return "_rad"; }
  std::string_view operator()(const pbd::AxisJoint&) const { return "_rad"; }
  std::string_view operator()(const pbd::PerpendicularJoint&) const { return "_rad"; }
  std::string_view operator()(const pbd::RotationJoint&) const { return "_rad"; }
  std::string_view operator()(const pbd::AngleJoint&) const { return "_rad"; }
  template <class OfLengths>
  std::string_view operator()(const OfLengths&) const {
    return "_m";
  }
};

std::string_view error_unit(const pbd::Effect& effect) {
  return std::visit(Unit{}, effect);
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
  for_turning_bodies(scene, [&](int body, const pbd::Vec3& inertia) {
    angular += state.orientation[static_cast<std::size_t>(body)] *
               inertia.cwiseProduct(pbd::Vec3(state.spin.col(body)));
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
  for_turning_bodies(scene, [&](int body, const pbd::Vec3& inertia) {
    const pbd::Vec3 spin = state.spin.col(body);
    energy += spin.dot(inertia.cwiseProduct(spin)) / 2;
  });
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
  for_each_constraint_of(scene, scene.effects, state, [&](const auto& value, const auto& compliance) {
    if (!is_hard(compliance)) energy += value.dot(compliance.llt().solve(value)) / 2;
  });
  return energy;
}

double constraint_error(const pbd::Scene& scene, const pbd::Effect& effect, const pbd::State& state) {
  double largest = 0;
  for_each_constraint_of(scene, std::array{std::cref(effect)}, state,
                         [&](const auto& value, const auto& compliance) {
                           if (is_hard(compliance)) largest = std::max(largest, value.norm());
                         });
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
        if (has_rows(effect)) row.emplace_back(constraint_error(scene, effect, state));
  }
}

}  // namespace pbdcheck
