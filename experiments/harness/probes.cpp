#include "harness/probes.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>

#include "effects/sources.h"
#include "harness/contact_sums.h"
#include "harness/joint_force.h"
#include "harness/placed.h"

namespace pbdcheck {
namespace {

/// Of all effects chosen, what their constraints are in a state.
template <class Effects>
pbd::ConstraintMeasure measured(const pbd::Scene& scene, const Effects& effects, const pbd::State& state) {
  const Placed placed(scene, state);
  pbd::ConstraintMeasure sum;
  for (const pbd::Effect& effect : effects)
    if (const auto source = pbd::make_source(scene, effect, pbd::Friction::coulomb))
      source->measure(placed.at(), sum);
  return sum;
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

template <class E, class... Listed>
constexpr bool one_of = (std::is_same_v<E, Listed> || ...);

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

/// Centre of mass, velocity and angular velocity (in the world) of a body, where a probe's point is then.
struct BodyPoint {
  pbd::Vec3 position, velocity, angular_velocity;

  BodyPoint(const pbd::Scene& scene, const pbd::State& state, const Probe& probe) {
    const auto index = static_cast<std::size_t>(probe.body);
    const int node = scene.bodies[index].node;
    const pbd::Vec3 lever = state.orientation[index] * probe.point;
    angular_velocity = state.orientation[index] * pbd::Vec3(state.spin.col(probe.body));
    position = state.x.col(node) + lever;
    velocity = state.v.col(node) + angular_velocity.cross(lever);
  }
};

std::vector<std::string> columns_of(const Probe& probe, const pbd::Scene& scene) {
  const std::string begin = probe.name.empty() ? "" : probe.name + "_";
  std::vector<std::string> columns;
  const auto per_axis = [&](std::string_view pattern) {
    for (const char axis : {'x', 'y', 'z'})
      columns.push_back(begin + fmt::format(fmt::runtime(pattern), axis));
  };
  if (probe.kind == "position") per_axis("{}_m");
  if (probe.kind == "velocity") per_axis("v{}_m_s");
  if (probe.kind == "orientation")
    for (const char part : {'w', 'x', 'y', 'z'}) columns.push_back(begin + fmt::format("q{}", part));
  if (probe.kind == "angular_velocity") per_axis("w{}_rad_s");
  if (probe.kind == "joint_force") {
    per_axis("force_{}_n");
    per_axis("torque_{}_n_m");
  }
  if (probe.kind == "contact_force") {
    per_axis("contact_force_{}_n");
    per_axis("friction_force_{}_n");
  }
  if (probe.kind == "contacts")
    for (const auto* name : {"contacts", "least_gap_m"}) columns.push_back(begin + name);
  if (probe.kind == "energy")
    for (const EnergyTerm& term : energy_terms) columns.push_back(fmt::format("{}{}_j", begin, term.name));
  if (probe.kind == "momentum") {
    per_axis("momentum_{}_kg_m_s");
    per_axis("angular_momentum_{}_kg_m2_s");
  }
  if (probe.kind == "constraint_error")
    for (std::size_t i = 0; i < scene.effects.size(); ++i)
      if (const auto unit = error_unit(scene.effects[i])) {
        const auto name = std::visit([](const auto& effect) { return effect.name; }, scene.effects[i]);
        columns.push_back(fmt::format("{}{}_{}_error{}", begin, name, i, *unit));
      }
  return columns;
}

/// Six cells, empty ones before the first step, which no force is known of.
void append_joint_force(const SceneFile& file, const NamedJoint& joint, const pbd::State& state,
                        const pbd::Workspace* stepped, std::vector<Cell>& row) {
  if (stepped == nullptr) {
    row.insert(row.end(), 6, "");
    return;
  }
  const Wrench wrench = joint_force(joint, file.scene, state, *stepped);
  append(row, wrench.force);
  append(row, wrench.torque);
}

/// Empty cells before the first step, and for the gap where nothing is near.
void append_contact(const SceneFile& file, const Probe& probe, const pbd::Workspace* stepped,
                    std::vector<Cell>& row) {
  const bool force = probe.kind == "contact_force";
  if (stepped == nullptr) {
    row.insert(row.end(), force ? 6 : 2, "");
    return;
  }
  const auto found = stepped->contacts();
  if (force) {
    const auto sum = contact_force(*contact_of(file.scene), found, probe.body, probe.other);
    append(row, sum.force);
    append(row, sum.friction);
  } else {
    row.emplace_back(pressing(found));
    const auto gap = least_gap(found);
    row.emplace_back(gap ? Cell(*gap) : Cell(""));
  }
}

}  // namespace

std::optional<std::string_view> error_unit(const pbd::Effect& effect) {
  using namespace pbd;
  return std::visit(
      []<class E>(const E&) -> std::optional<std::string_view> {
        constexpr bool none = one_of<E, Gravity, ExternalForce, ExternalTorque, Gyroscopic, Contact>;
        constexpr bool strain = one_of<E, TriangleStrain, TetStrain>;
        constexpr bool angle = one_of<E, Bending, AxisJoint, PerpendicularJoint, RotationJoint, AngleJoint>;
        constexpr bool length =
            one_of<E, Anchor, Distance, PointJoint, LineJoint, BodyDistance, SlideJoint, Attachment>;
        static_assert(none + strain + angle + length == 1, "state the unit of the effect's error, or none");
        if (none) return {};
        return strain ? "" : angle ? "_rad" : "_m";
      },
      effect);
}

double finite_mass(const pbd::Scene& scene) {
  double sum = 0;
  for (const double mass : scene.mass) sum += std::isfinite(mass) ? mass : 0;
  return sum;
}

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
  return measured(scene, scene.effects, state).energy;
}

double total_energy(const pbd::Scene& scene, const pbd::State& state) {
  double sum = 0;
  for (const EnergyTerm& term : energy_terms) sum += term.of(scene, state);
  return sum;
}

double constraint_error(const pbd::Scene& scene, const pbd::Effect& effect, const pbd::State& state) {
  return measured(scene, std::array{std::cref(effect)}, state).missed;
}

std::vector<std::string> probe_columns(const SceneFile& file) {
  std::vector<std::string> columns;
  for (const auto& probe : file.probes)
    for (auto& column : columns_of(probe, file.scene)) columns.push_back(std::move(column));
  return columns;
}

void append_probes(const SceneFile& file, const pbd::State& state, const pbd::Workspace* stepped,
                   std::vector<Cell>& row) {
  const pbd::Scene& scene = file.scene;
  for (const auto& probe : file.probes) {
    const bool position = probe.kind == "position", velocity = probe.kind == "velocity";
    if (position && probe.body < 0) append(row, state.x.col(probe.node));
    if (velocity && probe.body < 0) append(row, state.v.col(probe.node));
    if (position && probe.body >= 0) append(row, BodyPoint(scene, state, probe).position);
    if (velocity && probe.body >= 0) append(row, BodyPoint(scene, state, probe).velocity);
    if (probe.kind == "angular_velocity") append(row, BodyPoint(scene, state, probe).angular_velocity);
    if (probe.kind == "orientation") {
      const auto& q = state.orientation[static_cast<std::size_t>(probe.body)];
      for (const double part : {q.w(), q.x(), q.y(), q.z()}) row.emplace_back(part);
    }
    if (probe.kind == "joint_force") append_joint_force(file, file.joints[probe.joint], state, stepped, row);
    if (probe.kind.starts_with("contact")) append_contact(file, probe, stepped, row);
    if (probe.kind == "energy")
      for (const EnergyTerm& term : energy_terms) row.emplace_back(term.of(scene, state));
    if (probe.kind == "momentum") append_momentum(scene, state, row);
    if (probe.kind == "constraint_error")
      for (const auto& effect : scene.effects)
        if (error_unit(effect)) row.emplace_back(constraint_error(scene, effect, state));
  }
}

}  // namespace pbdcheck
