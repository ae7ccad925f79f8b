// c = u_a . u_b; dc/dphi_a = (u_a x u_b)^T = -dc/dphi_b.
#pragma once

#include "effects/joint_parts.h"

namespace pbd {

template <>
struct Constraint<PerpendicularJoint> : JointConstraint<PerpendicularJoint, 1> {
  static constexpr double turned_out = 0.866;  // |c|, sine of 60 degrees

  static void evaluate(const PerpendicularJoint& effect, std::size_t i, const Positions& at, Value& value,
                       Jacobian& jacobian);
  static NodeBounds geometric_bound(const PerpendicularJoint& effect, std::size_t i, const Positions& at,
                                    const Value& impulse);
};

std::unique_ptr<Source> make_source(const Scene& scene, const PerpendicularJoint& effect);

}  // namespace pbd
