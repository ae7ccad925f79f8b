// Small bodies of one effect each, to be loaded until their geometric stiffness matters.
#pragma once

#include <string>
#include <vector>

#include "scene.h"

namespace pbdcheck {

/// A body of one effect. Loads (N) stretch it where positive; the stiffnesses' unit is the effect's own.
struct OneEffectBody {
  std::string effect, strain, unit;
  std::vector<double> stiffnesses, loads;
  pbd::Scene (*make)(double stiffness);
  pbd::Vec3 direction;  // of the load, on the nodes farthest along x
};

/// One for each effect and strain.
std::vector<OneEffectBody> one_effect_bodies();

/// Adds `load` (N) on the nodes farthest along x, shared equally, and a slow motion without any symmetry.
void load_and_stir(pbd::Scene& scene, const pbd::Vec3& load);

}  // namespace pbdcheck
