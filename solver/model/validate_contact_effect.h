// Checks of contact; throws SetupError (validate.h).
#pragma once

#include "effect_check.h"

namespace pbd {

void validate(const EffectCheck& check, const Contact& effect);

}  // namespace pbd
