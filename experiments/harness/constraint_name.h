// A constraint in the words of a scene file.
#pragma once

#include <string>
#include <vector>

#include "scenes/scene_file.h"
#include "step/step.h"

namespace pbdcheck {

/// By the names of joints and bodies, a contact by its two sides if the step's `contacts` are there; else by
/// effect and number.
std::string constraint_name(const SceneFile& file, const pbd::ConstraintIndex& index,
                            const std::vector<pbd::ContactForce>& contacts);

}  // namespace pbdcheck
