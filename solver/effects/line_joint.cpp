#include "effects/line_joint.h"

#include "rows/effect_rows.h"

namespace pbd {

void Constraint<LineJoint>::evaluate(const LineJoint& effect, std::size_t i, const Positions& at,
                                     Value& value, Jacobian& jacobian) {
  const Eigen::Matrix<double, 3, 2> normals = normals_of(effect.axis[i]);
  for (int k = 0; k < 2; ++k) {
    const Slide slide(*at.body[0], *at.body[1], normals.col(k), effect.point[i][1]);
    value[k] = slide.value() - normals.col(k).dot(effect.point[i][0]);
    jacobian.row(k) = slide.jacobian(*at.body[0], *at.body[1]);
  }
}

auto Constraint<LineJoint>::geometric_bound(const LineJoint& effect, std::size_t i, const Positions& at,
                                            const Value& impulse) -> NodeBounds {
  const Vec3 push = normals_of(effect.axis[i]) * impulse;
  const double size = push.norm();
  const Slide slide(*at.body[0], *at.body[1], size > 0 ? Vec3(push / size) : Vec3(effect.axis[i]),
                    effect.point[i][1]);
  return slide.bound(size, *at.body[0], *at.body[1]);
}

std::unique_ptr<Source> make_source(const Scene& scene, const LineJoint& effect) {
  return std::make_unique<EffectRows<LineJoint>>(scene, effect);
}

}  // namespace pbd
