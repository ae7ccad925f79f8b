// c = x_b + s_b - x_a - s_a, s = R p; J = [-1, [s_a]x R_a/r_a, 1, -[s_b]x R_b/r_b]. Damped joints have the
// same vector in body a's frame, R_a^T c, whose rate is none where both bodies turn as one.
#pragma once

#include "effects/joint_parts.h"

namespace pbd {

template <>
struct Constraint<PointJoint> : JointConstraint<PointJoint, 3> {
  static void evaluate(const PointJoint& effect, std::size_t i, const Positions& at, Value& value,
                       Jacobian& jacobian);
  static NodeBounds geometric_bound(const PointJoint& effect, std::size_t i, const Positions& at,
                                    const Value& impulse);
};

std::unique_ptr<Source> make_source(const Scene& scene, const PointJoint& effect);

}  // namespace pbd
