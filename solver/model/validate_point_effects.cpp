#include "validate_point_effects.h"

#include <cmath>

#include "validate.h"
#include "validate_texts.h"

namespace pbd {

void validate(const EffectCheck& check, const Gravity& effect) {
  REQUIRE(effect.acceleration.allFinite(), check.name + " acceleration", text(effect.acceleration),
          "finite numbers");
}

void validate(const EffectCheck& check, const ExternalForce& effect) {
  check.same_size(effect.node.size(), effect.force, "force");
  check.node_indices(effect.node);
  check.finite(effect.force, "force");
}

void validate(const EffectCheck& check, const Anchor& effect) {
  check.of_nodes(effect, effect.target, "target");
  for (std::size_t i = 0; i < effect.node.size(); ++i)
    REQUIRE(std::isfinite(check.scene.mass[effect.node[i]]), check.at(i, "node"),
            text(effect.node[i]) + ", of infinite mass", "a node of finite mass, which an anchor can hold");
}

void validate(const EffectCheck& check, const Distance& effect) {
  check.of_nodes(effect, effect.rest_length, "rest_length");
  check.not_negative(effect.rest_length, "rest_length");
  for (std::size_t i = 0; i < effect.rest_length.size(); ++i)
    REQUIRE(effect.rest_length[i] > 0 || effect.compliance[i] > 0, check.at(i, "rest_length"),
            "0 and compliance 0", "a rest length > 0 for a link without compliance");
}

void validate(const EffectCheck& check, const Bending& effect) {
  check.of_nodes(effect, effect.rest_angle, "rest_angle");
}

void validate(const EffectCheck& check, const TriangleStrain& effect) {
  check.same_size(effect.node.size(), effect.rest, "rest");
  check.node_indices(effect.node);
  check.material(effect.material, true);
  check.viscosity(effect.damping, effect.material);
  REQUIRE(effect.thickness > 0 && std::isfinite(effect.thickness), check.name + " thickness",
          text(effect.thickness), "a finite number > 0, m");
  const std::string triangle = check.name + " triangle ";
  for (std::size_t i = 0; i < effect.rest.size(); ++i) require_proper(effect.rest[i], triangle, i);
}

void validate(const EffectCheck& check, const TetStrain& effect) {
  check.same_size(effect.node.size(), effect.rest, "rest");
  check.node_indices(effect.node);
  check.material(effect.material, false);
  check.viscosity(effect.damping, effect.material);
  const std::string tetrahedron = check.name + " tetrahedron ";
  for (std::size_t i = 0; i < effect.rest.size(); ++i) require_proper(effect.rest[i], tetrahedron, i);
}

}  // namespace pbd
