// a = g for every node with finite mass.
#pragma once

#include <cmath>

#include "rows/constraint.h"

namespace pbd {

template <>
struct Force<Gravity> {
  static void add(const Gravity& effect, const Scene& scene, const ForceBegin&, Points& acceleration) {
    for (int node = 0; node < scene.nodes(); ++node)
      if (std::isfinite(scene.mass[node])) acceleration.col(node) += effect.acceleration;
  }
};

}  // namespace pbd
