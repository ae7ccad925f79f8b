// a = f / m; an infinite mass is not moved.
#pragma once

#include "effects/constraint.h"

namespace pbd {

template <>
struct Force<ExternalForce> {
  static void add(const ExternalForce& effect, const Scene& scene, const StepBegin&, Points& acceleration) {
    for (std::size_t i = 0; i < effect.node.size(); ++i)
      acceleration.col(effect.node[i]) +=
          effect.force[i] / scene.mass[static_cast<std::size_t>(effect.node[i])];
  }
};

}  // namespace pbd
