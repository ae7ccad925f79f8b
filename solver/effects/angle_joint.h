// c = theta - (rest_angle + rate t), theta = atan2(u . (e x f), e . f) with u, e the axis and the reference
// of a, f the reference of b, all in the world. With g = f - (u . f) u, the part of f across the axis,
// dtheta = (u x g) . df / |g|^2 and df = phi x f, hence dc/dphi_b = (f x (u x g))^T / |g|^2, and dc/dphi_a =
// -dc/dphi_b: only relative rotations count.
// A motor of limited force knows its place, not its speed: held back, it falls behind, and more than half a
// turn behind (2 pi are the same angle) it drives backwards. A limit holds within half a turn of itself, by
// where the step begins: within a step c does not jump, from one to the next by 2 pi where it passes pi.
#pragma once

#include <numbers>

#include "effects/joint_parts.h"

namespace pbd {

template <>
struct Constraint<AngleJoint> : JointConstraint<AngleJoint, 1> {
  static constexpr double period = 2 * std::numbers::pi;  // rad, of c

  static double angle_asked(const AngleJoint& effect, std::size_t i, double time) {
    return effect.rest_angle[i] + effect.rate[i] * time;
  }
  static void evaluate(const AngleJoint& effect, std::size_t i, const Positions& at, Value& value,
                       Jacobian& jacobian);
  static NodeBounds geometric_bound(const AngleJoint& effect, std::size_t i, const Positions& at,
                                    const Value& impulse);
  static Approach approach(const AngleJoint& effect, std::size_t i, const Positions& at, double gap);
};

std::unique_ptr<Source> make_source(const Scene& scene, const AngleJoint& effect);

}  // namespace pbd
