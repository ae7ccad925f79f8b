#include "effects/perpendicular_joint.h"

#include "rows/effect_rows.h"

namespace pbd {

void Constraint<PerpendicularJoint>::evaluate(const PerpendicularJoint& effect, std::size_t i,
                                              const Positions& at, Value& value, Jacobian& jacobian) {
  const Pose &a = *at.body[0], &b = *at.body[1];
  const Vec3 axis_a = a.rotation * effect.axis[i][0], axis_b = b.rotation * effect.axis[i][1];
  const Vec3 turn = axis_a.cross(axis_b);
  value[0] = axis_a.dot(axis_b);
  jacobian << Row3::Zero(), turn.transpose() * a.turn_per_arc, Row3::Zero(),
      -turn.transpose() * b.turn_per_arc;
}

auto Constraint<PerpendicularJoint>::geometric_bound(const PerpendicularJoint& effect, std::size_t i,
                                                     const Positions& at, const Value& impulse)
    -> NodeBounds {
  const Pose &a = *at.body[0], &b = *at.body[1];
  return product_of_directions(impulse[0] * (a.rotation * effect.axis[i][0]), b.rotation * effect.axis[i][1],
                               a, b);
}

std::unique_ptr<Source> make_source(const Scene& scene, const PerpendicularJoint& effect) {
  return std::make_unique<EffectRows<PerpendicularJoint>>(scene, effect);
}

}  // namespace pbd
