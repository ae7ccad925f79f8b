// c = 2 vec(e), e = r^-1 q_a^-1 q_b with scalar part e_0 >= 0. A rotation by phi of b multiplies e by
// (1, R_b^T phi / 2) from the right: dc/dphi_b = (e_0 I + [vec e]x) R_b^T; one of a by the opposite.
#pragma once

#include "effects/joint_parts.h"

namespace pbd {

template <>
struct Constraint<RotationJoint> : JointConstraint<RotationJoint, 3> {
  static constexpr double turned_out = 1;  // |c|, of 60 degrees

  static void evaluate(const RotationJoint& effect, std::size_t i, const Positions& at, Value& value,
                       Jacobian& jacobian);
  static NodeBounds geometric_bound(const RotationJoint& effect, std::size_t i, const Positions& at,
                                    const Value& impulse);
};

std::unique_ptr<Source> make_source(const Scene& scene, const RotationJoint& effect);

}  // namespace pbd
