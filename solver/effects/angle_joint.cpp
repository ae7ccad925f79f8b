#include "effects/angle_joint.h"

#include <algorithm>
#include <cmath>

#include "rows/effect_rows.h"

namespace pbd {
namespace {

/// The angle of b's reference `to` about a's axis from a's reference, and its derivative by `to`.
struct Twist {
  Vec3 to, across;  // across: to without its part along the axis
  double squared;   // |across|^2
  Vec3 gradient;    // axis x across / |across|^2
  double angle;

  Twist(const AngleJoint& effect, std::size_t i, const Pose& a, const Pose& b)
      : to(b.rotation * effect.reference[i][1]) {
    const Vec3 axis = a.rotation * effect.axis[i], from = a.rotation * effect.reference[i][0];
    angle = std::atan2(axis.dot(from.cross(to)), from.dot(to));
    across = to - axis.dot(to) * axis;
    squared = across.squaredNorm();
    gradient = squared > 0 ? Vec3(axis.cross(across) / squared) : Vec3(Vec3::Zero());
  }
};
}  // namespace

void Constraint<AngleJoint>::evaluate(const AngleJoint& effect, std::size_t i, const Positions& at,
                                      Value& value, Jacobian& jacobian) {
  const Pose &a = *at.body[0], &b = *at.body[1];
  const Twist twist(effect, i, a, b);
  value[0] = std::remainder(twist.angle - effect.rest_angle[i] - effect.rate[i] * at.time, period);
  const Vec3 turn = twist.squared > 0 ? twist.to.cross(twist.gradient) : Vec3(a.rotation * effect.axis[i]);
  jacobian << Row3::Zero(), -turn.transpose() * a.turn_per_arc, Row3::Zero(),
      turn.transpose() * b.turn_per_arc;
}

/// With g = across and t = gradient the angle's second derivative by `to` is -(g t^T + t g^T) / |g|^2.
auto Constraint<AngleJoint>::geometric_bound(const AngleJoint& effect, std::size_t i, const Positions& at,
                                             const Value& impulse) -> NodeBounds {
  const Pose &a = *at.body[0], &b = *at.body[1];
  const Twist twist(effect, i, a, b);
  if (!(twist.squared > 0)) return NodeBounds::Zero();
  const Eigen::Matrix3d product = twist.across * twist.gradient.transpose(), turn = cross_matrix(twist.to);
  const Eigen::Matrix3d by_turn = turn.transpose() * (product + product.transpose()) * turn / twist.squared;
  return rotation_bound(impulse[0] * by_turn + lever_form(impulse[0] * twist.gradient, twist.to),
                        impulse[0] * twist.to.cross(twist.gradient), a, b);
}

/// g moves by at most 2 turn in a's frame, by a part p of its length turns the angle by asin(p) at most, and
/// that is no more than pi/3 p up to p = 1/2, pi/6. From pi on c is on the limit's other side.
Approach Constraint<AngleJoint>::approach(const AngleJoint& effect, std::size_t i, const Positions& at,
                                          double gap) {
  const Twist twist(effect, i, *at.body[0], *at.body[1]);
  const double left = std::min({gap, period / 2 - gap, std::numbers::pi / 6});
  return {.by_turn = 2 * std::numbers::pi / 3 / (std::sqrt(twist.squared) * left),
          .by_time = std::abs(effect.rate[i]) / left};
}

std::unique_ptr<Source> make_source(const Scene& scene, const AngleJoint& effect) {
  return std::make_unique<EffectRows<AngleJoint>>(scene, effect);
}

}  // namespace pbd
