#include "validate_effect.h"

#include "validate_body_effects.h"
#include "validate_contact_effect.h"
#include "validate_point_effects.h"
#include "validate_texts.h"

namespace pbd {

void validate_effect(const Scene& scene, std::size_t index) {
  std::visit(
      [&](const auto& effect) {
        validate(EffectCheck{scene, "effects[" + text(index) + "] " + std::string(effect.name)}, effect);
      },
      scene.effects[index]);
}

}  // namespace pbd
