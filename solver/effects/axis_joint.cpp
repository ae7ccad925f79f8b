#include "effects/axis_joint.h"

#include "rows/effect_rows.h"

namespace pbd {

void Constraint<AxisJoint>::evaluate(const AxisJoint& effect, std::size_t i, const Positions& at,
                                     Value& value, Jacobian& jacobian) {
  const Pose &a = *at.body[0], &b = *at.body[1];
  const Eigen::Matrix<double, 3, 2> normals = a.rotation * normals_of(effect.axis[i][0]);
  const Vec3 axis = b.rotation * effect.axis[i][1];
  for (int k = 0; k < 2; ++k) {
    const Vec3 normal = normals.col(k), turn = normal.cross(axis);
    value[k] = normal.dot(axis);
    jacobian.row(k) << Row3::Zero(), turn.transpose() * a.turn_per_arc, Row3::Zero(),
        -turn.transpose() * b.turn_per_arc;
  }
}

auto Constraint<AxisJoint>::geometric_bound(const AxisJoint& effect, std::size_t i, const Positions& at,
                                            const Value& impulse) -> NodeBounds {
  const Pose &a = *at.body[0], &b = *at.body[1];
  return product_of_directions(a.rotation * normals_of(effect.axis[i][0]) * impulse,
                               b.rotation * effect.axis[i][1], a, b);
}

std::unique_ptr<Source> make_source(const Scene& scene, const AxisJoint& effect) {
  return std::make_unique<EffectRows<AxisJoint>>(scene, effect);
}

}  // namespace pbd
