// a = g for every node with finite mass.
#pragma once

#include <cmath>

#include "effects/constraint.h"

namespace pbd {

template <>
struct Force<Gravity> {
  static void add(const Gravity& effect, const Scene& scene, const StepBegin&, Points& acceleration) {
    for (int node = 0; node < scene.nodes(); ++node)
      if (std::isfinite(scene.mass[static_cast<std::size_t>(node)]))
        acceleration.col(node) += effect.acceleration;
  }
};

}  // namespace pbd
