#include "effects/distance.h"

#include "rows/effect_rows.h"

namespace pbd {

auto Constraint<Distance>::node(const Distance& effect, std::size_t i) -> Nodes {
  return effect.node[i];
}

double Constraint<Distance>::compliance_scale(const Distance& effect, std::size_t i) {
  return effect.compliance[i];
}

auto Constraint<Distance>::retardation(const Distance& effect, std::size_t i) -> Square {
  return Square(effect.damping[i]);
}

Vec3 Constraint<Distance>::gradient(const Distance& effect, std::size_t i, const Positions& x, Value& value) {
  const Vec3 link = x.col(1) - x.col(0);
  const double length = link.norm();
  value[0] = length - effect.rest_length[i];
  return length > 0 ? Vec3(link / length) : Vec3::UnitX();
}

void Constraint<Distance>::evaluate(const Distance& effect, std::size_t i, const Positions& x, Value& value,
                                    Jacobian& jacobian) {
  const Vec3 by_second = gradient(effect, i, x, value);
  jacobian << -by_second.transpose(), by_second.transpose();
}

void Constraint<Distance>::linearise(const Distance& effect, std::size_t i, const Positions& x, Value& value,
                                     LinkJacobians& jacobians, std::size_t row) {
  jacobians.set(row, gradient(effect, i, x, value));
}

auto Constraint<Distance>::geometric_bound(const Distance&, std::size_t, const Positions& x,
                                           const Value& impulse) -> NodeBounds {
  const double length = (x.col(1) - x.col(0)).norm();
  return NodeBounds::Constant(length > 0 ? std::max(0.0, -impulse[0]) * 2 / length : 0.0);
}

auto Constraint<Distance>::geometric_stiffness(const Distance&, std::size_t, const Positions& x,
                                               const Value& impulse, bool convex) -> Stiffness {
  const Vec3 link = x.col(1) - x.col(0);
  const double length = link.norm(), tension = -impulse[0];
  if (!(length > 0) || (convex && tension < 0)) return Stiffness::Zero();
  const Vec3 along = link / length;
  const Eigen::Matrix3d across = tension / length * (Eigen::Matrix3d::Identity() - along * along.transpose());
  Stiffness stiffness;
  stiffness << across, -across, -across, across;
  return stiffness;
}

std::unique_ptr<Source> make_source(const Scene& scene, const Distance& effect) {
  return std::make_unique<EffectRows<Distance>>(scene, effect);
}

}  // namespace pbd
