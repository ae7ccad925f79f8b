// c = x - target, J = I.
#pragma once

#include "effects/constraint.h"

namespace pbd {

template <>
struct Constraint<Anchor> : ConstraintShape<3, 1> {
  static constexpr bool fills_space = true;

  static Nodes node(const Anchor& effect, std::size_t i) { return {effect.node[i]}; }

  static Square compliance(const Anchor& effect, std::size_t i) {
    return effect.compliance[i] * Square::Identity();
  }

  static Square retardation(const Anchor& effect, std::size_t i) {
    return effect.damping[i] * Square::Identity();
  }

  static void evaluate(const Anchor& effect, std::size_t i, const Positions& x, Value& value,
                       Jacobian& jacobian) {
    value = x - effect.target[i];
    jacobian.setIdentity();
  }

  static NodeBounds geometric_bound(const Anchor&, std::size_t, const Positions&, const Value&) {
    return NodeBounds::Zero();
  }
};

}  // namespace pbd
