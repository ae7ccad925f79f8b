// The steps that experiments do: a scene, its state before the step, the step's length.
#pragma once

#include <string>

#include "scene.h"

namespace pbdcheck {

struct Case {
  std::string name;
  pbd::Scene scene;
  double h;              // s, of the step in question
  double lead_step = 0;  // s
  int lead_steps = 0;    // steps of `lead_step` by `truth` from the scene's initial state to the step's start
};

}  // namespace pbdcheck
