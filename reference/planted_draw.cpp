#include "planted_draw.h"

#include <cmath>

namespace pbd::reference::planted {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

double Random::between(double low, double high) {
  return low + (high - low) * static_cast<double>(generator_() >> 11U) * 0x1p-53;
}
double Random::decades(double low, double high) {
  return std::pow(10, between(low, high));
}
Vector2d Random::direction() {
  const double angle = between(0, 2 * M_PI);
  return {std::cos(angle), std::sin(angle)};
}
Vector3d Random::vector() {
  return {between(-1, 1), between(-1, 1), between(-1, 1)};
}

Planted plant(FrictionLaw law, ContactState state, double mu, double size, Random& random) {
  Planted at;
  const Vector2d t = random.direction();
  const double hover = law == FrictionLaw::cone ? mu : 0;  // u_N / |u_T| of a sliding contact
  const double within = random.between(0, 0.9), speed = random.between(0.1, 1);
  if (state == ContactState::sticking) at.r << 1, within * mu * t;
  if (state == ContactState::sliding) at.r << 1, mu * t;
  if (state == ContactState::sliding) at.u << hover * speed, -speed * t;
  if (state == ContactState::separated) at.u << hover * within + speed, within * t;
  at.r *= size;
  return at;
}

std::vector<Planted> plant_all(FrictionLaw law, const VectorXd& friction, double both_zero, Random& random) {
  const auto contacts = static_cast<int>(friction.size());
  const int degenerate = static_cast<int>(std::lround(both_zero * contacts));
  std::vector<Planted> all;
  for (int i = 0; i < contacts; ++i) {
    const auto state =
        i >= contacts - degenerate ? ContactState::both_zero : static_cast<ContactState>(i % 3);
    all.push_back(plant(law, state, friction(i), random.between(0.5, 2), random));
  }
  return all;
}

VectorXd frictions(int contacts, Random& random) {
  return VectorXd::NullaryExpr(contacts, [&] { return random.between(0.1, 1); });
}

PlantedCone finish(const SparseMatrix& jacobian, const VectorXd& inverse_mass, VectorXd friction,
                   const std::vector<Planted>& planted) {
  PlantedCone p;
  p.problem.delassus = jacobian * inverse_mass.asDiagonal() * SparseMatrix(jacobian.transpose());
  p.problem.friction = std::move(friction);
  const Eigen::Index rows = 3 * planted.size();
  p.impulse.resize(rows), p.velocity.resize(rows);
  for (std::size_t i = 0; i < planted.size(); ++i) {
    p.impulse.segment<3>(3 * i) = planted[i].r;
    p.velocity.segment<3>(3 * i) = planted[i].u;
  }
  p.problem.free_velocity = p.velocity - p.problem.delassus * p.impulse;
  return p;
}

}  // namespace pbd::reference::planted
