// Planted contact problems of bodies of six coordinates: cubes on each other, in a wedge, many in a band.
#include <Eigen/Geometry>
#include <cmath>

#include "planted_draw.h"

namespace pbd::reference {
namespace planted {

using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

/// Body a is pushed along the normal by body b (-1: fixed) at arms from their centres.
struct Corner {
  int a, b;
  Vector3d arm_a, arm_b, normal;
};

SparseMatrix jacobian_of(const std::vector<Corner>& corners, int bodies) {
  Triplets entries;
  for (int i = 0; i < static_cast<int>(corners.size()); ++i) {
    const Corner& c = corners[i];
    const Vector3d first = c.normal.unitOrthogonal(), second = c.normal.cross(first);
    for (int k = 0; k < 3; ++k) {
      const Vector3d d = k == 0 ? c.normal : k == 1 ? first : second;
      const auto add = [&](int body, const Vector3d& arm, double sign) {
        if (body < 0) return;
        const Vector3d turn = arm.cross(d);
        for (int l = 0; l < 3; ++l) {
          entries.emplace_back(3 * i + k, 6 * body + l, sign * d(l));
          entries.emplace_back(3 * i + k, 6 * body + 3 + l, sign * turn(l));
        }
      };
      add(c.a, c.arm_a, 1);
      add(c.b, c.arm_b, -1);
    }
  }
  return from_triplets(3 * corners.size(), 6 * bodies, entries);
}

/// Unit cubes of these masses, kg.
VectorXd cube_inverse_mass(const std::vector<double>& mass) {
  VectorXd inverse(6 * mass.size());
  for (std::size_t b = 0; b < mass.size(); ++b)
    inverse.segment<6>(6 * b) << Vector3d::Constant(1 / mass[b]), Vector3d::Constant(6 / mass[b]);
  return inverse;
}

/// Unit cubes on each other. An impulse carries the weight above, unevenly; each joint sticks or slides as
/// one.
PlantedCone stack(FrictionLaw law, std::uint64_t seed, int boxes, double growth) {
  Random random(seed);
  std::vector<double> mass;
  std::vector<Corner> corners;
  std::vector<Planted> planted;
  VectorXd friction(4 * boxes);
  for (int b = 0; b < boxes; ++b) mass.push_back(std::pow(growth, b));
  for (int b = 0; b < boxes; ++b) {
    double above = 0;
    for (int k = b; k < boxes; ++k) above += mass[k];
    const double mu = random.between(0.2, 0.8);
    const ContactState state = random.between(0, 1) < 0.6 ? ContactState::sticking : ContactState::sliding;
    const Planted joint = plant(law, state, mu, 1, random);
    for (int corner = 0; corner < 4; ++corner) {
      const int row = corner / 2;
      const Vector3d at(corner % 2 - 0.5, row - 0.5, 0);
      corners.push_back({b, b - 1, at - Vector3d(0, 0, 0.5), at + Vector3d(0, 0, 0.5), Vector3d::UnitZ()});
      planted.push_back({random.between(0.2, 0.3) * above * joint.r, joint.u});
      friction(4 * b + corner) = mu;
    }
  }
  return finish(jacobian_of(corners, boxes), cube_inverse_mass(mass), std::move(friction), planted);
}

/// Many bodies in a band.
PlantedCone band(FrictionLaw law, int contacts, int bodies, double mass_decades, double zero_share,
                 std::uint64_t seed) {
  Random random(seed);
  std::vector<Corner> corners;
  for (int i = 0; i < contacts; ++i) {
    const int a = i % bodies, b = (a + 1 + i / bodies) % bodies;
    corners.push_back({a, b, random.vector() / 2, random.vector() / 2, random.vector().normalized()});
  }
  VectorXd inverse_mass(6 * bodies);
  for (int b = 0; b < bodies; ++b) {
    const double mass = random.decades(0, mass_decades);
    inverse_mass.segment<6>(6 * b) << Vector3d::Constant(1 / mass), Vector3d::Constant(6 / mass);
  }
  VectorXd friction = frictions(contacts, random);
  const auto planted = plant_all(law, friction, zero_share, random);
  return finish(jacobian_of(corners, bodies), inverse_mass, std::move(friction), planted);
}

}  // namespace

PlantedCone two_boxes(FrictionLaw law, std::uint64_t seed) {
  return stack(law, seed, 2, 1);
}
PlantedCone heavy_top(FrictionLaw law, std::uint64_t seed) {
  return stack(law, seed, 5, 10);
}

/// A cube between two walls that lean by up to 0.1: friction holds it with any squeeze.
PlantedCone wedge(FrictionLaw law, std::uint64_t seed) {
  Random random(seed);
  std::vector<Corner> corners;
  std::vector<Planted> planted;
  VectorXd friction(8);
  for (const double side : {-1.0, 1.0}) {
    const double mu = random.between(0.3, 0.8);
    const Vector3d lean = 0.1 * random.vector();
    const Vector3d normal = Vector3d(-side, lean.y(), lean.z()).normalized();
    for (int corner = 0; corner < 4; ++corner) {
      friction(corners.size()) = mu;
      const int row = corner / 2;
      corners.push_back({0, -1, Vector3d(side / 2, corner % 2 - 0.5, row - 0.5), Vector3d::Zero(), normal});
      planted.push_back(plant(law, ContactState::sticking, mu, random.between(0.5, 2), random));
    }
  }
  return finish(jacobian_of(corners, 1), cube_inverse_mass({1}), std::move(friction), planted);
}

}  // namespace planted

PlantedCone planted_regular(FrictionLaw law, int contacts, std::uint64_t seed) {
  return planted::band(law, contacts, 2 * contacts / 3, 0.3, 0, seed);
}
PlantedCone planted_hard(FrictionLaw law, int contacts, std::uint64_t seed) {
  return planted::band(law, contacts, contacts / 3, 4, 0.05, seed);
}

}  // namespace pbd::reference
