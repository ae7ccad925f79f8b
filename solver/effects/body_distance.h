// c = |y_b - y_a| - l0, y = x + s, s = R p; with u the unit vector from y_a to y_b
//   J = [-u^T, -(s_a x u)^T R_a/r_a, u^T, (s_b x u)^T R_b/r_b].
// Coinciding points have no direction; they are parted along x.
#pragma once

#include "effects/joint_parts.h"

namespace pbd {

template <>
struct Constraint<BodyDistance> : JointConstraint<BodyDistance, 1> {
  static void evaluate(const BodyDistance& effect, std::size_t i, const Positions& at, Value& value,
                       Jacobian& jacobian);
  static NodeBounds geometric_bound(const BodyDistance& effect, std::size_t i, const Positions& at,
                                    const Value& impulse);
  static Approach approach(const BodyDistance& effect, std::size_t i, const Positions&, double gap) {
    const auto& [a, b] = effect.point[i];
    return {.by_way = 2 / gap, .by_turn = (a.norm() + b.norm()) / gap};
  }
};

std::unique_ptr<Source> make_source(const Scene& scene, const BodyDistance& effect);

}  // namespace pbd
