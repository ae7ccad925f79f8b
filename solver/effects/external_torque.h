// I w' = torque, in the axes of the body where the step begins.
#pragma once

#include "rows/constraint.h"

namespace pbd {

template <>
struct Force<ExternalTorque> {
  static void add(const ExternalTorque& effect, const Scene&, const ForceBegin& begin, Points& acceleration) {
    for (std::size_t i = 0; i < effect.body.size(); ++i) {
      const int body = effect.body[i];
      acceleration.col(begin.bodies.column(body)) +=
          begin.bodies.acceleration(body, effect.torque[i], begin.pose[body]);
    }
  }
};

}  // namespace pbd
