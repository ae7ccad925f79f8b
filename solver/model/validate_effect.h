// Checks of one effect of a scene.
#pragma once

#include <cstddef>

#include "scene.h"

namespace pbd {

/// Throws SetupError unless what the scene's effect of that index says is allowed (validate.h).
void validate_effect(const Scene& scene, std::size_t index);

}  // namespace pbd
