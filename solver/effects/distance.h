// c = |x1 - x0| - l0, J = [-u^T, u^T] with u = (x1 - x0)/|x1 - x0|.
// Coinciding ends have no direction; they are parted along x.
#pragma once

#include <algorithm>

#include "effects/constraint.h"

namespace pbd {

template <>
struct Constraint<Distance> : ConstraintShape<1, 2> {
  static Nodes node(const Distance& effect, std::size_t i) { return effect.node[i]; }

  static Square compliance(const Distance& effect, std::size_t i) { return Square(effect.compliance[i]); }

  static Square retardation(const Distance& effect, std::size_t i) { return Square(effect.damping[i]); }

  static void evaluate(const Distance& effect, std::size_t i, const Positions& x, Value& value,
                       Jacobian& jacobian) {
    const Vec3 link = x.col(1) - x.col(0);
    const double length = link.norm();
    const Vec3 direction = length > 0 ? Vec3(link / length) : Vec3::UnitX();
    value[0] = length - effect.rest_length[i];
    jacobian << -direction.transpose(), direction.transpose();
  }

  /// d2c/dx2 = (I - u u^T)/length [1 -1; -1 1], of norm 2/length.
  static NodeBounds geometric_bound(const Distance&, std::size_t, const Positions& x, const Value& impulse) {
    const double length = (x.col(1) - x.col(0)).norm();
    return NodeBounds::Constant(length > 0 ? std::max(0.0, -impulse[0]) * 2 / length : 0.0);
  }
};

}  // namespace pbd
