// Checks of the effects on nodes; each throws SetupError (validate.h).
#pragma once

#include "effect_check.h"

namespace pbd {

void validate(const EffectCheck& check, const Gravity& effect);
void validate(const EffectCheck& check, const ExternalForce& effect);
void validate(const EffectCheck& check, const Anchor& effect);
void validate(const EffectCheck& check, const Distance& effect);
void validate(const EffectCheck& check, const Bending& effect);
void validate(const EffectCheck& check, const TriangleStrain& effect);
void validate(const EffectCheck& check, const TetStrain& effect);

}  // namespace pbd
