// c_k = t_k . u, t_k = R_a t_k0 at right angles to a's axis, u = R_b u_b0; dc/dphi_a = (t x u)^T, dc/dphi_b =
// (u x t)^T.
#pragma once

#include "effects/joint_parts.h"

namespace pbd {

template <>
struct Constraint<AxisJoint> : JointConstraint<AxisJoint, 2> {
  static constexpr double turned_out = 0.866;  // |c|, sine of 60 degrees

  static void evaluate(const AxisJoint& effect, std::size_t i, const Positions& at, Value& value,
                       Jacobian& jacobian);
  static NodeBounds geometric_bound(const AxisJoint& effect, std::size_t i, const Positions& at,
                                    const Value& impulse);
};

std::unique_ptr<Source> make_source(const Scene& scene, const AxisJoint& effect);

}  // namespace pbd
