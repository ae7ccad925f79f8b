#include "validate_contact_effect.h"

#include <cmath>

#include "validate.h"
#include "validate_texts.h"

namespace pbd {
namespace {

void validate_laws(const EffectCheck& check, const Contact& effect) {
  REQUIRE(effect.materials > 0, check.name + " materials", text(effect.materials), "at least one");
  const auto materials = static_cast<std::size_t>(effect.materials);
  REQUIRE(effect.law.size() == materials * materials, check.name + " law",
          text(effect.law.size()) + " entries", "one per pair of materials, " + text(materials * materials));
  for (std::size_t i = 0; i < effect.law.size(); ++i) {
    const ContactLaw& law = effect.law[i];
    REQUIRE(law.friction >= 0 && law.friction <= most_friction, check.at(i, "friction"), text(law.friction),
            "0 to " + text(most_friction));
    REQUIRE(law.restitution >= 0 && law.restitution <= 1, check.at(i, "restitution"), text(law.restitution),
            "0 to 1");
    check.not_negative({law.compliance}, "compliance");
    check.not_negative({law.damping}, "damping");
  }
}

}  // namespace

void validate(const EffectCheck& check, const Contact& effect) {
  check.only_one<Contact>();
  const auto material_index = [&](int material, std::size_t i, std::string_view field) {
    REQUIRE(material >= 0 && material < effect.materials, check.at(i, field), text(material),
            "a material from 0 to " + text(effect.materials - 1));
  };
  for (std::size_t i = 0; i < effect.collider.size(); ++i) {
    check.body_index(effect.collider[i].body, i);
    material_index(effect.collider[i].material, i, "collider material");
  }
  check.same_size(effect.node.size(), effect.radius, "radius");
  check.same_size(effect.node.size(), effect.node_material, "node_material");
  check.node_indices(effect.node);
  check.not_negative(effect.radius, "radius");
  for (std::size_t i = 0; i < effect.node.size(); ++i)
    material_index(effect.node_material[i], i, "node_material");
  check.node_indices(effect.triangle);
  REQUIRE(effect.thickness >= 0 && std::isfinite(effect.thickness), check.name + " thickness",
          text(effect.thickness), "a finite number >= 0, m");
  material_index(effect.surface_material, 0, "surface_material");
  validate_laws(check, effect);
  for (std::size_t i = 0; i < effect.apart.size(); ++i)
    for (const int body : effect.apart[i]) check.body_index(body, i);
  check.not_negative({effect.margin}, "margin");
  REQUIRE(effect.recovery >= 0, check.name + " recovery", text(effect.recovery), "a number >= 0, m/s");
}

}  // namespace pbd
