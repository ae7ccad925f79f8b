#include "validate_effect.h"

#include <cmath>

#include "mesh.h"
#include "validate.h"
#include "validate_texts.h"

namespace pbd {
namespace {

/// Checks of one effect; `name` is its position and kind in the scene, as in "effects[2] distance".
struct EffectCheck {
  const Scene& scene;
  std::string name;

  std::string at(std::size_t i, std::string_view field) const {
    return name + " " + std::string(field) + "[" + text(i) + "]";
  }

  template <class Entries>
  void same_size(std::size_t expected, const Entries& entries, std::string_view field) const {
    REQUIRE(entries.size() == expected, name + " " + std::string(field), text(entries.size()) + " entries",
            "one entry per constraint, " + text(expected));
  }

  void node_index(int node, std::size_t i) const {
    REQUIRE(node >= 0 && node < scene.nodes(), at(i, "node"), text(node),
            "a node index from 0 to " + text(scene.nodes() - 1));
  }

  template <std::size_t K>
  void node_indices(const std::vector<std::array<int, K>>& node) const {
    for (std::size_t i = 0; i < node.size(); ++i)
      for (std::size_t a = 0; a < K; ++a) {
        node_index(node[i][a], i);
        for (std::size_t b = 0; b < a; ++b)
          REQUIRE(node[i][a] != node[i][b], at(i, "node"), text(node[i][a]) + " twice", "different nodes");
      }
  }

  void node_indices(const std::vector<int>& node) const {
    for (std::size_t i = 0; i < node.size(); ++i) node_index(node[i], i);
  }

  void not_negative(const std::vector<double>& values, std::string_view field) const {
    for (std::size_t i = 0; i < values.size(); ++i)
      REQUIRE(values[i] >= 0 && std::isfinite(values[i]), at(i, field), text(values[i]),
              "a finite number >= 0");
  }

  void finite(const std::vector<double>& values, std::string_view field) const {
    for (std::size_t i = 0; i < values.size(); ++i)
      REQUIRE(std::isfinite(values[i]), at(i, field), text(values[i]), "a finite number");
  }

  void finite(const std::vector<Vec3>& values, std::string_view field) const {
    for (std::size_t i = 0; i < values.size(); ++i)
      REQUIRE(values[i].allFinite(), at(i, field), text(values[i]), "finite numbers");
  }

  void material(const Material& m, bool may_be_rigid) const {
    REQUIRE(m.young > 0 && (may_be_rigid || std::isfinite(m.young)), name + " young", text(m.young),
            may_be_rigid ? "a number > 0, Pa (inf for a rigid one)" : "a finite number > 0, Pa");
    REQUIRE(m.poisson > -1 && m.poisson < 0.5, name + " poisson", text(m.poisson), "-1 < poisson < 0.5");
  }

  void retardation_times(std::size_t constraints, const std::vector<double>& damping) const {
    if (damping.empty()) return;
    same_size(constraints, damping, "damping");
    not_negative(damping, "damping");
  }

  void viscosity(const std::optional<Material>& damping, const Material& elastic) const {
    if (!damping) return;
    EffectCheck{scene, name + " damping"}.material(*damping, false);
    REQUIRE(std::isfinite(elastic.young), name + " damping", "moduli of a rigid material",
            "damping of a finite young");
  }

  /// Nodes, compliance, damping and the finite value at rest of each constraint.
  template <class OfNodes, class Values>
  void of_nodes(const OfNodes& effect, const Values& rest, std::string_view field) const {
    const std::size_t count = effect.node.size();
    same_size(count, rest, field);
    same_size(count, effect.compliance, "compliance");
    node_indices(effect.node);
    finite(rest, field);
    not_negative(effect.compliance, "compliance");
    retardation_times(count, effect.damping);
  }

  void body_index(int body, std::size_t i) const {
    const auto count = static_cast<int>(scene.bodies.size());
    REQUIRE(
        body >= 0 && (body < count), at(i, "body"), text(body),
        (count > 0) ? "a rigid body's index from 0 to " + text(count - 1) : "no body: the scene has none");
  }

  /// Two bodies each, and one entry a joint of everything else.
  template <class Joint>
  void joint(const Joint& effect) const {
    const std::size_t count = effect.body.size();
    for (std::size_t i = 0; i < count; ++i) {
      for (const int body : effect.body[i]) body_index(body, i);
      REQUIRE(effect.body[i][0] != effect.body[i][1], at(i, "body"), text(effect.body[i][0]) + " twice",
              "two different bodies");
    }
    same_size(count, effect.compliance, "compliance");
    not_negative(effect.compliance, "compliance");
    retardation_times(count, effect.damping);
    if constexpr (requires { effect.bounds; })
      if (!effect.bounds.empty()) {
        same_size(count, effect.bounds, "bounds");
        for (std::size_t i = 0; i < count; ++i) {
          const auto [lower, upper] = effect.bounds[i];
          REQUIRE(lower <= 0 && upper >= 0 && lower < upper, at(i, "bounds"),
                  "(" + text(lower) + ", " + text(upper) + ")", "a lower one <= 0 and an upper one >= 0");
        }
      }
    if constexpr (requires { effect.point; }) {
      same_size(count, effect.point, "point");
      for (std::size_t i = 0; i < count; ++i)
        for (const Vec3& point : effect.point[i])
          REQUIRE(point.allFinite(), at(i, "point"), text(point), "finite numbers");
    }
    if constexpr (requires { effect.axis; }) {
      same_size(count, effect.axis, "axis");
      for (std::size_t i = 0; i < count; ++i) unit(effect.axis[i], i, "axis");
    }
  }

  void unit(const Vec3& vector, std::size_t i, std::string_view field) const {
    constexpr double slack = 1e-9;
    REQUIRE(std::abs(vector.norm() - 1) <= slack, at(i, field), text(vector), "a vector of length 1");
  }
  void unit(const std::array<Vec3, 2>& pair, std::size_t i, std::string_view field) const {
    for (const Vec3& vector : pair) unit(vector, i, field);
  }

  void operator()(const ExternalTorque& effect) const {
    same_size(effect.body.size(), effect.torque, "torque");
    for (std::size_t i = 0; i < effect.body.size(); ++i) body_index(effect.body[i], i);
    finite(effect.torque, "torque");
  }

  void operator()(const Gyroscopic&) const {
    int count = 0;
    for (const Effect& effect : scene.effects) count += std::holds_alternative<Gyroscopic>(effect);
    REQUIRE(count == 1, name, text(count) + " of them", "one in a scene");
  }

  void operator()(const PointJoint& effect) const { joint(effect); }
  void operator()(const AxisJoint& effect) const { joint(effect); }
  void operator()(const PerpendicularJoint& effect) const { joint(effect); }
  void operator()(const LineJoint& effect) const { joint(effect); }

  void operator()(const RotationJoint& effect) const {
    joint(effect);
    same_size(effect.body.size(), effect.rest, "rest");
    for (std::size_t i = 0; i < effect.rest.size(); ++i)
      REQUIRE(is_unit(effect.rest[i]), at(i, "rest"), norm_of(effect.rest[i]), "norm 1");
  }

  void operator()(const BodyDistance& effect) const {
    joint(effect);
    same_size(effect.body.size(), effect.rest_length, "rest_length");
    not_negative(effect.rest_length, "rest_length");
    for (std::size_t i = 0; i < effect.rest_length.size(); ++i)
      REQUIRE(effect.rest_length[i] > 0 || effect.compliance[i] > 0, at(i, "rest_length"),
              "0 and compliance 0", "a rest length > 0 for a link without compliance, or a point_joint");
  }

  void operator()(const AngleJoint& effect) const {
    joint(effect);
    same_size(effect.body.size(), effect.reference, "reference");
    same_size(effect.body.size(), effect.rest_angle, "rest_angle");
    same_size(effect.body.size(), effect.rate, "rate");
    finite(effect.rest_angle, "rest_angle");
    finite(effect.rate, "rate");
    for (std::size_t i = 0; i < effect.reference.size(); ++i) {
      unit(effect.reference[i], i, "reference");
      constexpr double slack = 1e-9;
      REQUIRE(std::abs(effect.reference[i][0].dot(effect.axis[i])) <= slack, at(i, "reference"),
              text(effect.reference[i][0]), "a direction at right angles to the axis");
    }
  }

  void operator()(const SlideJoint& effect) const {
    joint(effect);
    same_size(effect.body.size(), effect.rest_position, "rest_position");
    same_size(effect.body.size(), effect.rate, "rate");
    finite(effect.rest_position, "rest_position");
    finite(effect.rate, "rate");
  }

  void operator()(const Attachment& effect) const {
    const std::size_t count = effect.body.size();
    same_size(count, effect.node, "node");
    same_size(count, effect.point, "point");
    same_size(count, effect.compliance, "compliance");
    node_indices(effect.node);
    for (std::size_t i = 0; i < count; ++i) {
      body_index(effect.body[i], i);
      REQUIRE(effect.node[i] != scene.bodies[static_cast<std::size_t>(effect.body[i])].node, at(i, "node"),
              text(effect.node[i]) + ", the body's own", "another node than the body's centre of mass");
    }
    finite(effect.point, "point");
    not_negative(effect.compliance, "compliance");
    retardation_times(count, effect.damping);
  }

  void operator()(const Contact& effect) const {
    int count = 0;
    for (const Effect& other : scene.effects) count += std::holds_alternative<Contact>(other);
    REQUIRE(count == 1, name, text(count) + " of them", "one in a scene");
    const auto material_index = [&](int material, std::size_t i, std::string_view field) {
      REQUIRE(material >= 0 && material < effect.materials, at(i, field), text(material),
              "a material from 0 to " + text(effect.materials - 1));
    };
    for (std::size_t i = 0; i < effect.collider.size(); ++i) {
      body_index(effect.collider[i].body, i);
      material_index(effect.collider[i].material, i, "collider material");
    }
    same_size(effect.node.size(), effect.radius, "radius");
    same_size(effect.node.size(), effect.node_material, "node_material");
    node_indices(effect.node);
    not_negative(effect.radius, "radius");
    for (std::size_t i = 0; i < effect.node.size(); ++i)
      material_index(effect.node_material[i], i, "node_material");
    node_indices(effect.triangle);
    REQUIRE(effect.thickness >= 0 && std::isfinite(effect.thickness), name + " thickness",
            text(effect.thickness), "a finite number >= 0, m");
    material_index(effect.surface_material, 0, "surface_material");
    REQUIRE(effect.materials > 0, name + " materials", text(effect.materials), "at least one");
    const auto materials = static_cast<std::size_t>(effect.materials);
    REQUIRE(effect.law.size() == materials * materials, name + " law", text(effect.law.size()) + " entries",
            "one per pair of materials, " + text(materials * materials));
    for (std::size_t i = 0; i < effect.law.size(); ++i) {
      const ContactLaw& law = effect.law[i];
      REQUIRE(law.friction >= 0 && law.friction <= most_friction, at(i, "friction"), text(law.friction),
              "0 to " + text(most_friction));
      REQUIRE(law.restitution >= 0 && law.restitution <= 1, at(i, "restitution"), text(law.restitution),
              "0 to 1");
      not_negative({law.compliance}, "compliance");
      not_negative({law.damping}, "damping");
    }
    for (std::size_t i = 0; i < effect.apart.size(); ++i)
      for (const int body : effect.apart[i]) body_index(body, i);
    not_negative({effect.margin}, "margin");
    REQUIRE(effect.recovery >= 0, name + " recovery", text(effect.recovery), "a number >= 0, m/s");
  }

  void operator()(const Gravity& effect) const {
    REQUIRE(effect.acceleration.allFinite(), name + " acceleration", text(effect.acceleration),
            "finite numbers");
  }

  void operator()(const ExternalForce& effect) const {
    same_size(effect.node.size(), effect.force, "force");
    node_indices(effect.node);
    finite(effect.force, "force");
  }

  void operator()(const Anchor& effect) const {
    of_nodes(effect, effect.target, "target");
    for (std::size_t i = 0; i < effect.node.size(); ++i)
      REQUIRE(std::isfinite(scene.mass[static_cast<std::size_t>(effect.node[i])]), at(i, "node"),
              text(effect.node[i]) + ", of infinite mass", "a node of finite mass, which an anchor can hold");
  }

  void operator()(const Distance& effect) const {
    of_nodes(effect, effect.rest_length, "rest_length");
    not_negative(effect.rest_length, "rest_length");
    for (std::size_t i = 0; i < effect.rest_length.size(); ++i)
      REQUIRE(effect.rest_length[i] > 0 || effect.compliance[i] > 0, at(i, "rest_length"),
              "0 and compliance 0", "a rest length > 0 for a link without compliance");
  }

  void operator()(const Bending& effect) const { of_nodes(effect, effect.rest_angle, "rest_angle"); }

  void operator()(const TriangleStrain& effect) const {
    same_size(effect.node.size(), effect.rest, "rest");
    node_indices(effect.node);
    material(effect.material, true);
    viscosity(effect.damping, effect.material);
    REQUIRE(effect.thickness > 0 && std::isfinite(effect.thickness), name + " thickness",
            text(effect.thickness), "a finite number > 0, m");
    const std::string triangle = name + " triangle ";
    for (std::size_t i = 0; i < effect.rest.size(); ++i) require_proper(effect.rest[i], triangle, i);
  }

  void operator()(const TetStrain& effect) const {
    same_size(effect.node.size(), effect.rest, "rest");
    node_indices(effect.node);
    material(effect.material, false);
    viscosity(effect.damping, effect.material);
    const std::string tetrahedron = name + " tetrahedron ";
    for (std::size_t i = 0; i < effect.rest.size(); ++i) require_proper(effect.rest[i], tetrahedron, i);
  }
};

}  // namespace

void validate_effect(const Scene& scene, std::size_t index) {
  std::visit(
      [&](const auto& effect) {
        EffectCheck{scene, "effects[" + text(index) + "] " + std::string(effect.name)}(effect);
      },
      scene.effects[index]);
}

}  // namespace pbd
