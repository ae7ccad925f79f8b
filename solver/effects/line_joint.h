// c_k = t_k . (y_b - x_a) - t_k0 . p_a, t_k = R_a t_k0 at right angles to a's axis (joint_parts.h, Slide).
#pragma once

#include "effects/joint_parts.h"

namespace pbd {

template <>
struct Constraint<LineJoint> : JointConstraint<LineJoint, 2> {
  static void evaluate(const LineJoint& effect, std::size_t i, const Positions& at, Value& value,
                       Jacobian& jacobian);
  static NodeBounds geometric_bound(const LineJoint& effect, std::size_t i, const Positions& at,
                                    const Value& impulse);
};

std::unique_ptr<Source> make_source(const Scene& scene, const LineJoint& effect);

}  // namespace pbd
