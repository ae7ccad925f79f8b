#include "effects/attachment.h"

#include "rows/effect_rows.h"

namespace pbd {

void Constraint<Attachment>::evaluate(const Attachment& effect, std::size_t i, const Positions& at,
                                      Value& value, Jacobian& jacobian) {
  const Pose& body = *at.body[0];
  if (!effect.damping.empty()) {
    const Vec3 gap = at.node - body.x;
    const Square into = body.rotation.transpose();
    value = into * gap - effect.point[i];
    jacobian << -into, into * cross_matrix(gap) * body.turn_per_arc, into;
    return;
  }
  const Vec3 lever = body.rotation * effect.point[i];
  value = at.node - body.x - lever;
  jacobian << -Square::Identity(), cross_matrix(lever) * body.turn_per_arc, Square::Identity();
}

auto Constraint<Attachment>::geometric_bound(const Attachment& effect, std::size_t i, const Positions& at,
                                             const Value& impulse) -> NodeBounds {
  const Pose& body = *at.body[0];
  if (!effect.damping.empty()) {
    const Pose node{at.node, Square::Identity(), Square::Zero()};  // a body that does not turn
    return Slide(body, node, impulse, Vec3::Zero()).bound(1, body, node).template head<3>();
  }
  return {0, largest_of(lever_form(-impulse, body.rotation * effect.point[i]), body), 0};
}

std::unique_ptr<Source> make_source(const Scene& scene, const Attachment& effect) {
  return std::make_unique<EffectRows<Attachment>>(scene, effect);
}

}  // namespace pbd
