#include "effect_check.h"

#include <cmath>

#include "validate_texts.h"

namespace pbd {

std::string EffectCheck::at(std::size_t i, std::string_view field) const {
  return name + " " + std::string(field) + "[" + text(i) + "]";
}

void EffectCheck::entries(std::size_t expected, std::size_t count, std::string_view field) const {
  REQUIRE(count == expected, name + " " + std::string(field), text(count) + " entries",
          "one entry per constraint, " + text(expected));
}

void EffectCheck::one_in_a_scene(int count) const {
  REQUIRE(count == 1, name, text(count) + " of them", "one in a scene");
}

void EffectCheck::node_index(int node, std::size_t i) const {
  REQUIRE(node >= 0 && node < scene.nodes(), at(i, "node"), text(node),
          "a node index from 0 to " + text(scene.nodes() - 1));
}

void EffectCheck::different_nodes(int node, int other, std::size_t i) const {
  REQUIRE(node != other, at(i, "node"), text(node) + " twice", "different nodes");
}

void EffectCheck::node_indices(const std::vector<int>& node) const {
  for (std::size_t i = 0; i < node.size(); ++i) node_index(node[i], i);
}

void EffectCheck::body_index(int body, std::size_t i) const {
  const auto count = static_cast<int>(scene.bodies.size());
  REQUIRE(body >= 0 && (body < count), at(i, "body"), text(body),
          (count > 0) ? "a rigid body's index from 0 to " + text(count - 1) : "no body: the scene has none");
}

void EffectCheck::not_negative(const std::vector<double>& values, std::string_view field) const {
  for (std::size_t i = 0; i < values.size(); ++i)
    REQUIRE(values[i] >= 0 && std::isfinite(values[i]), at(i, field), text(values[i]),
            "a finite number >= 0");
}

void EffectCheck::finite(const std::vector<double>& values, std::string_view field) const {
  for (std::size_t i = 0; i < values.size(); ++i)
    REQUIRE(std::isfinite(values[i]), at(i, field), text(values[i]), "a finite number");
}

void EffectCheck::finite(const std::vector<Vec3>& values, std::string_view field) const {
  for (std::size_t i = 0; i < values.size(); ++i)
    REQUIRE(values[i].allFinite(), at(i, field), text(values[i]), "finite numbers");
}

void EffectCheck::unit(const Vec3& vector, std::size_t i, std::string_view field) const {
  REQUIRE(std::abs(vector.norm() - 1) <= unit_slack, at(i, field), text(vector), "a vector of length 1");
}

void EffectCheck::unit(const std::array<Vec3, 2>& pair, std::size_t i, std::string_view field) const {
  for (const Vec3& vector : pair) unit(vector, i, field);
}

void EffectCheck::material(const Material& stated, bool may_be_rigid) const {
  REQUIRE(stated.young > 0 && (may_be_rigid || std::isfinite(stated.young)), name + " young",
          text(stated.young),
          may_be_rigid ? "a number > 0, Pa (inf for a rigid one)" : "a finite number > 0, Pa");
  REQUIRE(stated.poisson > -1 && stated.poisson < 0.5, name + " poisson", text(stated.poisson),
          "-1 < poisson < 0.5");
}

void EffectCheck::retardation_times(std::size_t constraints, const std::vector<double>& damping) const {
  if (damping.empty()) return;
  same_size(constraints, damping, "damping");
  not_negative(damping, "damping");
}

void EffectCheck::viscosity(const std::optional<Material>& damping, const Material& elastic) const {
  if (!damping) return;
  EffectCheck{scene, name + " damping"}.material(*damping, false);
  REQUIRE(std::isfinite(elastic.young), name + " damping", "moduli of a rigid material",
          "damping of a finite young");
}

}  // namespace pbd
