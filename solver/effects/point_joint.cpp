#include "effects/point_joint.h"

#include "rows/effect_rows.h"

namespace pbd {

void Constraint<PointJoint>::evaluate(const PointJoint& effect, std::size_t i, const Positions& at,
                                      Value& value, Jacobian& jacobian) {
  const Pose &a = *at.body[0], &b = *at.body[1];
  if (!effect.damping.empty()) {
    for (int k = 0; k < 3; ++k) {
      const Slide along(a, b, Vec3::Unit(k), effect.point[i][1]);
      value[k] = along.value() - effect.point[i][0][k];
      jacobian.row(k) = along.jacobian(a, b);
    }
    return;
  }
  const Vec3 lever_a = a.rotation * effect.point[i][0], lever_b = b.rotation * effect.point[i][1];
  value = b.x + lever_b - a.x - lever_a;
  jacobian << -Square::Identity(), cross_matrix(lever_a) * a.turn_per_arc, Square::Identity(),
      -cross_matrix(lever_b) * b.turn_per_arc;
}

auto Constraint<PointJoint>::geometric_bound(const PointJoint& effect, std::size_t i, const Positions& at,
                                             const Value& impulse) -> NodeBounds {
  const Pose &a = *at.body[0], &b = *at.body[1];
  if (!effect.damping.empty()) return Slide(a, b, impulse, effect.point[i][1]).bound(1, a, b);
  return {0, largest_of(lever_form(-impulse, a.rotation * effect.point[i][0]), a), 0,
          largest_of(lever_form(impulse, b.rotation * effect.point[i][1]), b)};
}

std::unique_ptr<Source> make_source(const Scene& scene, const PointJoint& effect) {
  return std::make_unique<EffectRows<PointJoint>>(scene, effect);
}

}  // namespace pbd
