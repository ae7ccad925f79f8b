// I w' = -w x I w where the step begins; the implicit form is the step's own (outer/step_system.h).
#pragma once

#include "rows/constraint.h"

namespace pbd {

template <>
struct Force<Gyroscopic> {
  static void add(const Gyroscopic& effect, const Scene&, const ForceBegin& begin, Points& acceleration) {
    if (effect.implicit && !begin.explicit_forces) return;
    for (int body = 0; body < begin.bodies.count(); ++body) {
      const Eigen::Index column = begin.bodies.column(body);
      acceleration.col(column) += begin.bodies.gyroscopic(body, begin.v.col(column));
    }
  }
};

}  // namespace pbd
