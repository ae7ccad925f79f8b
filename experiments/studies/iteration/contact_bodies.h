// Small scenes of bodies that rest, roll, slide or tumble on what they touch, so that the way of a contact's
// normal or place matters.
#pragma once

#include <string>
#include <vector>

#include "scene.h"

namespace pbdcheck {

struct TouchingBody {
  std::string name;
  pbd::Scene (*make)();
};

/// All touch as they begin; none has a gyroscopic torque.
std::vector<TouchingBody> touching_bodies();

}  // namespace pbdcheck
