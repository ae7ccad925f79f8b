#include "effects/slide_joint.h"

#include "rows/effect_rows.h"

namespace pbd {

void Constraint<SlideJoint>::evaluate(const SlideJoint& effect, std::size_t i, const Positions& at,
                                      Value& value, Jacobian& jacobian) {
  const Slide slide(*at.body[0], *at.body[1], effect.axis[i], effect.point[i][1]);
  value[0] = slide.value() - effect.axis[i].dot(effect.point[i][0]) - effect.rest_position[i] -
             effect.rate[i] * at.time;
  jacobian = slide.jacobian(*at.body[0], *at.body[1]);
}

auto Constraint<SlideJoint>::geometric_bound(const SlideJoint& effect, std::size_t i, const Positions& at,
                                             const Value& impulse) -> NodeBounds {
  const Slide slide(*at.body[0], *at.body[1], effect.axis[i], effect.point[i][1]);
  return slide.bound(impulse[0], *at.body[0], *at.body[1]);
}

std::unique_ptr<Source> make_source(const Scene& scene, const SlideJoint& effect) {
  return std::make_unique<EffectRows<SlideJoint>>(scene, effect);
}

}  // namespace pbd
