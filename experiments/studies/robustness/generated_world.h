// Scenes nobody would draw of everything there is: bodies of all shapes, joints, held nodes, cloth and
// solids, damping, limits, contact of all laws; and a method for each.
#pragma once

#include <cstdint>

#include "method.h"
#include "scene.h"

namespace pbdcheck {

struct World {
  pbd::Scene scene;
  pbd::Method method;
  double h = 0;  // s
};

/// World `index` of the sequence begun by pbdcheck::seed. One to six bodies of 0.2 to 0.8 m fall, fly and
/// spin in cells of 1 m or less, so that some overlap from the start, mostly above tilted ground; densities
/// over three decades; each joint, surface, damping and law is there or not. The step is 1 ms to 30 ms;
/// integrator, outer iteration, linear solver and law of friction are any that take such a scene.
World generated_world(std::int64_t index);

}  // namespace pbdcheck
