#include "effects/bending.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <utility>

#include "rows/effect_rows.h"

namespace pbd {
namespace {

Vec3 wing_gradient(const Vec3& normal, double length) {
  const double square = normal.squaredNorm();
  return square > 0 ? Vec3(-length / square * normal) : Vec3::Zero();
}

}  // namespace

auto Constraint<Bending>::node(const Bending& effect, std::size_t i) -> Nodes {
  return effect.node[i];
}

double Constraint<Bending>::compliance_scale(const Bending& effect, std::size_t i) {
  return effect.compliance[i];
}

auto Constraint<Bending>::retardation(const Bending& effect, std::size_t i) -> Square {
  return Square(effect.damping[i]);
}

void Constraint<Bending>::evaluate(const Bending& effect, std::size_t i, const Positions& x, Value& value,
                                   Jacobian& jacobian) {
  const Vec3 edge = x.col(1) - x.col(0);
  const Vec3 wing_a = x.col(2) - x.col(0);
  const Vec3 wing_b = x.col(3) - x.col(0);
  const Vec3 normal_a = edge.cross(wing_a);
  const Vec3 normal_b = wing_b.cross(edge);
  const double length = edge.norm();

  const double sine = length > 0 ? normal_a.cross(normal_b).dot(edge) / length : 0.0;
  const double angle = std::atan2(sine, normal_a.dot(normal_b));
  value[0] = std::remainder(angle - effect.rest_angle[i], 2 * std::numbers::pi);

  const Vec3 gradient_a = wing_gradient(normal_a, length);
  const Vec3 gradient_b = wing_gradient(normal_b, length);
  const double inverse_square = length > 0 ? 1 / (length * length) : 0.0;
  const double t_a = wing_a.dot(edge) * inverse_square;
  const double t_b = wing_b.dot(edge) * inverse_square;
  jacobian << (-(1 - t_a) * gradient_a - (1 - t_b) * gradient_b).transpose(),
      (-t_a * gradient_a - t_b * gradient_b).transpose(), gradient_a.transpose(), gradient_b.transpose();
}

auto Constraint<Bending>::geometric_bound(const Bending&, std::size_t, const Positions& x,
                                          const Value& impulse) -> NodeBounds {
  const Vec3 edge = x.col(1) - x.col(0);
  const double length = edge.norm();
  if (!(length > 0)) return NodeBounds::Zero();
  const auto wing = [&](int column) {
    const Vec3 to_wing = x.col(column) - x.col(0);
    const double doubled_area = edge.cross(to_wing).norm();
    return std::pair{to_wing.dot(edge) / (length * length), doubled_area > 0 ? length / doubled_area : 0.0};
  };
  const auto [t_a, inverse_a] = wing(2);
  const auto [t_b, inverse_b] = wing(3);
  NodeBounds s;
  s << std::abs(1 - t_a) * inverse_a + std::abs(1 - t_b) * inverse_b + 1 / length,
      std::abs(t_a) * inverse_a + std::abs(t_b) * inverse_b + 1 / length, inverse_a, inverse_b;
  return std::abs(impulse[0]) * s.sum() * s;
}

std::unique_ptr<Source> make_source(const Scene& scene, const Bending& effect) {
  return std::make_unique<EffectRows<Bending>>(scene, effect);
}

}  // namespace pbd
