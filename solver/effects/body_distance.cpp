#include "effects/body_distance.h"

#include "rows/effect_rows.h"

namespace pbd {
namespace {

struct Link {
  Vec3 lever_a, lever_b, direction;
  double length;

  Link(const BodyDistance& effect, std::size_t i, const Pose& a, const Pose& b)
      : lever_a(a.rotation * effect.point[i][0]), lever_b(b.rotation * effect.point[i][1]) {
    const Vec3 link = b.x + lever_b - a.x - lever_a;
    length = link.norm();
    direction = length > 0 ? Vec3(link / length) : Vec3::UnitX();
  }
};
}  // namespace

void Constraint<BodyDistance>::evaluate(const BodyDistance& effect, std::size_t i, const Positions& at,
                                        Value& value, Jacobian& jacobian) {
  const Pose &a = *at.body[0], &b = *at.body[1];
  const Link link(effect, i, a, b);
  value[0] = link.length - effect.rest_length[i];
  jacobian << -link.direction.transpose(), -link.lever_a.cross(link.direction).transpose() * a.turn_per_arc,
      link.direction.transpose(), link.lever_b.cross(link.direction).transpose() * b.turn_per_arc;
}

/// |dy_b - dy_a|^2 <= 4 (|dx_a|^2 + |s_a|^2 |phi_a|^2 + ...), over the length, and the levers' own.
auto Constraint<BodyDistance>::geometric_bound(const BodyDistance& effect, std::size_t i, const Positions& at,
                                               const Value& impulse) -> NodeBounds {
  const Pose &a = *at.body[0], &b = *at.body[1];
  const Link link(effect, i, a, b);
  const double tension = link.length > 0 ? std::max(0.0, -impulse[0]) * 4 / link.length : 0.0;
  const Vec3 push = impulse[0] * link.direction;
  const auto arc = [&](const Pose& pose, double sign, const Vec3& lever) {
    const Eigen::Matrix3d turn = cross_matrix(lever);
    return largest_of(tension * turn.transpose() * turn + lever_form(sign * push, lever), pose);
  };
  return {tension, arc(a, -1, link.lever_a), tension, arc(b, 1, link.lever_b)};
}

std::unique_ptr<Source> make_source(const Scene& scene, const BodyDistance& effect) {
  return std::make_unique<EffectRows<BodyDistance>>(scene, effect);
}

}  // namespace pbd
