// All joints of rigid bodies: their values and Jacobians by (x_a, arc_a, x_b, arc_b), arcs in R/r (bodies.h).
#pragma once

#include "effects/constraint.h"

namespace pbd {

/// What all joints state alike.
template <class Joint, int R, int B = 2, int P = 0>
struct JointConstraint : BodyConstraintShape<R, B, P> {
  using Square = typename ConstraintShape<R, 2 * B + P>::Square;

  static std::array<int, static_cast<std::size_t>(B)> body(const Joint& effect, std::size_t i) {
    return {effect.body[i]};
  }
  static Square compliance(const Joint& effect, std::size_t i) {
    return effect.compliance[i] * Square::Identity();
  }
  static Square retardation(const Joint& effect, std::size_t i) {
    return effect.damping[i] * Square::Identity();
  }
};

// c = x_b + s_b - x_a - s_a, s = R p; J = [-1, [s_a]x R_a/r_a, 1, -[s_b]x R_b/r_b].
template <>
struct Constraint<PointJoint> : JointConstraint<PointJoint, 3> {
  static void evaluate(const PointJoint& effect, std::size_t i, const Positions& at, Value& value,
                       Jacobian& jacobian);
  static NodeBounds geometric_bound(const PointJoint& effect, std::size_t i, const Positions& at,
                                    const Value& impulse);
};

// c_k = t_k . (y_b - x_a) - t_k0 . p_a, t_k = R_a t_k0 at right angles to a's axis (joint_parts.h, Slide).
template <>
struct Constraint<LineJoint> : JointConstraint<LineJoint, 2> {
  static void evaluate(const LineJoint& effect, std::size_t i, const Positions& at, Value& value,
                       Jacobian& jacobian);
  static NodeBounds geometric_bound(const LineJoint& effect, std::size_t i, const Positions& at,
                                    const Value& impulse);
};

// c = u_a . (y_b - x_a) - u_a0 . p_a - (rest_position + rate t) (joint_parts.h, Slide).
template <>
struct Constraint<SlideJoint> : JointConstraint<SlideJoint, 1> {
  static void evaluate(const SlideJoint& effect, std::size_t i, const Positions& at, Value& value,
                       Jacobian& jacobian);
  static NodeBounds geometric_bound(const SlideJoint& effect, std::size_t i, const Positions& at,
                                    const Value& impulse);
};

// c = |y_b - y_a| - l0, y = x + s, s = R p; with u the unit vector from y_a to y_b
//   J = [-u^T, -(s_a x u)^T R_a/r_a, u^T, (s_b x u)^T R_b/r_b].
// Coinciding points have no direction; they are parted along x.
template <>
struct Constraint<BodyDistance> : JointConstraint<BodyDistance, 1> {
  static void evaluate(const BodyDistance& effect, std::size_t i, const Positions& at, Value& value,
                       Jacobian& jacobian);
  static NodeBounds geometric_bound(const BodyDistance& effect, std::size_t i, const Positions& at,
                                    const Value& impulse);
};

// c = x_node - x - s, s = R p; J = [-1, [s]x R/r, 1].
template <>
struct Constraint<Attachment> : JointConstraint<Attachment, 3, 1, 1> {
  static void evaluate(const Attachment& effect, std::size_t i, const Positions& at, Value& value,
                       Jacobian& jacobian);
  static NodeBounds geometric_bound(const Attachment& effect, std::size_t i, const Positions& at,
                                    const Value& impulse);
};

// c_k = t_k . u, t_k = R_a t_k0 at right angles to a's axis, u = R_b u_b0; dc/dphi_a = (t x u)^T, dc/dphi_b =
// (u x t)^T.
template <>
struct Constraint<AxisJoint> : JointConstraint<AxisJoint, 2> {
  static void evaluate(const AxisJoint& effect, std::size_t i, const Positions& at, Value& value,
                       Jacobian& jacobian);
  static NodeBounds geometric_bound(const AxisJoint& effect, std::size_t i, const Positions& at,
                                    const Value& impulse);
};

// c = u_a . u_b; dc/dphi_a = (u_a x u_b)^T = -dc/dphi_b.
template <>
struct Constraint<PerpendicularJoint> : JointConstraint<PerpendicularJoint, 1> {
  static void evaluate(const PerpendicularJoint& effect, std::size_t i, const Positions& at, Value& value,
                       Jacobian& jacobian);
  static NodeBounds geometric_bound(const PerpendicularJoint& effect, std::size_t i, const Positions& at,
                                    const Value& impulse);
};

// c = 2 vec(e), e = r^-1 q_a^-1 q_b with scalar part e_0 >= 0. A rotation by phi of b multiplies e by
// (1, R_b^T phi / 2) from the right: dc/dphi_b = (e_0 I + [vec e]x) R_b^T; one of a by the opposite.
template <>
struct Constraint<RotationJoint> : JointConstraint<RotationJoint, 3> {
  static void evaluate(const RotationJoint& effect, std::size_t i, const Positions& at, Value& value,
                       Jacobian& jacobian);
  static NodeBounds geometric_bound(const RotationJoint& effect, std::size_t i, const Positions& at,
                                    const Value& impulse);
};

// c = theta - (rest_angle + rate t), theta = atan2(u . (e x f), e . f) with u, e the axis and the reference
// of a, f the reference of b, all in the world. With g = f - (u . f) u, the part of f across the axis,
// dtheta = (u x g) . df / |g|^2 and df = phi x f, hence dc/dphi_b = (f x (u x g))^T / |g|^2, and dc/dphi_a =
// -dc/dphi_b: only relative rotations count.
template <>
struct Constraint<AngleJoint> : JointConstraint<AngleJoint, 1> {
  static void evaluate(const AngleJoint& effect, std::size_t i, const Positions& at, Value& value,
                       Jacobian& jacobian);
  static NodeBounds geometric_bound(const AngleJoint& effect, std::size_t i, const Positions& at,
                                    const Value& impulse);
};

}  // namespace pbd
