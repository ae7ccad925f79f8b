// a = f / m; an infinite mass is not moved.
#pragma once

#include "rows/constraint.h"

namespace pbd {

template <>
struct Force<ExternalForce> {
  static void add(const ExternalForce& effect, const Scene& scene, const ForceBegin&, Points& acceleration) {
    for (std::size_t i = 0; i < effect.node.size(); ++i)
      acceleration.col(effect.node[i]) += effect.force[i] / scene.mass[effect.node[i]];
  }
};

}  // namespace pbd
