// c = u_a . (y_b - x_a) - u_a0 . p_a - (rest_position + rate t) (joint_parts.h, Slide).
#pragma once

#include "effects/joint_parts.h"

namespace pbd {

template <>
struct Constraint<SlideJoint> : JointConstraint<SlideJoint, 1> {
  static void evaluate(const SlideJoint& effect, std::size_t i, const Positions& at, Value& value,
                       Jacobian& jacobian);
  static NodeBounds geometric_bound(const SlideJoint& effect, std::size_t i, const Positions& at,
                                    const Value& impulse);
  /// (t' - t) . (y - x_a) + t' . change of (y - x_a)
  static Approach approach(const SlideJoint& effect, std::size_t i, const Positions& at, double gap) {
    const Slide slide(*at.body[0], *at.body[1], effect.axis[i], effect.point[i][1]);
    return {.by_way = 2 / gap,
            .by_turn = (slide.gap.norm() + slide.lever.norm()) / gap,
            .by_time = std::abs(effect.rate[i]) / gap};
  }
};

std::unique_ptr<Source> make_source(const Scene& scene, const SlideJoint& effect);

}  // namespace pbd
