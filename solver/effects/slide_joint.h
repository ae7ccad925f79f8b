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
};

std::unique_ptr<Source> make_source(const Scene& scene, const SlideJoint& effect);

}  // namespace pbd
