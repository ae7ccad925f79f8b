#include "effects/attachment.h"

#include "rows/effect_rows.h"

namespace pbd {

void Constraint<Attachment>::evaluate(const Attachment& effect, std::size_t i, const Positions& at,
                                      Value& value, Jacobian& jacobian) {
  const Pose& body = *at.body[0];
  if (!effect.damping.empty()) {
    const Vec3 gap = at.node - body.x;
    value = body.rotation.transpose() * gap - effect.point[i];
    for (int k = 0; k < 3; ++k) {
      const Vec3 along = body.rotation.col(k);
      jacobian.row(k) << -along.transpose(), along.cross(gap).transpose() * body.turn_per_arc,
          along.transpose();
    }
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
    NodeBounds sum = NodeBounds::Zero();
    for (int k = 0; k < 3; ++k) {
      const Vec3 direction = body.rotation.col(k);
      const double along = std::abs(impulse[k]) * (cross_matrix(direction) * body.turn_per_arc).norm();
      const Eigen::Matrix3d form = lever_form(impulse[k] * Vec3(at.node - body.x), direction);
      sum += NodeBounds(along, largest_of(form, body) + 2 * along, along);
    }
    return sum;
  }
  return {0, largest_of(lever_form(-impulse, body.rotation * effect.point[i]), body), 0};
}

std::unique_ptr<Source> make_source(const Scene& scene, const Attachment& effect) {
  return std::make_unique<EffectRows<Attachment>>(scene, effect);
}

}  // namespace pbd
