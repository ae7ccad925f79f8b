// c = x - target, J = I.
#pragma once

#include "rows/constraint.h"
#include "rows/source.h"

namespace pbd {

template <>
struct Constraint<Anchor> : ConstraintShape<3, 1> {
  static constexpr bool fills_space = true;

  static Nodes node(const Anchor& effect, std::size_t i);
  static double compliance_scale(const Anchor& effect, std::size_t i);
  static Square retardation(const Anchor& effect, std::size_t i);
  static void evaluate(const Anchor& effect, std::size_t i, const Positions& x, Value& value,
                       Jacobian& jacobian);
  static NodeBounds geometric_bound(const Anchor& effect, std::size_t i, const Positions& x,
                                    const Value& impulse);
};

std::unique_ptr<Source> make_source(const Scene& scene, const Anchor& effect);

}  // namespace pbd
