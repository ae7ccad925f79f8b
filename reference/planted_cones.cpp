#include "planted_cones.h"

#include <Eigen/Geometry>
#include <cmath>
#include <random>

namespace pbd::reference {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Jacobian = Eigen::SparseMatrix<double>;

/// The same numbers everywhere: the standard library's distributions differ between libraries.
class Random {
 public:
  explicit Random(std::uint64_t seed) : generator_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_() >> 11U) * 0x1p-53;
  }
  double decades(double low, double high) { return std::pow(10, between(low, high)); }
  Vector2d direction() {
    const double angle = between(0, 2 * M_PI);
    return {std::cos(angle), std::sin(angle)};
  }
  Vector3d vector() { return {between(-1, 1), between(-1, 1), between(-1, 1)}; }

 private:
  std::mt19937_64 generator_;
};

enum class State { sticking, sliding, separated, both_zero };

/// r* and u* of one contact obeying the law.
struct Planted {
  Vector3d r = Vector3d::Zero(), u = Vector3d::Zero();
};
Planted plant(FrictionLaw law, State state, double mu, double size, Random& random) {
  Planted at;
  const Vector2d t = random.direction();
  const double hover = law == FrictionLaw::cone ? mu : 0;  // u_N / |u_T| of a sliding contact
  const double within = random.between(0, 0.9), speed = random.between(0.1, 1);
  if (state == State::sticking) at.r << 1, within * mu * t;
  if (state == State::sliding) at.r << 1, mu * t;
  if (state == State::sliding) at.u << hover * speed, -speed * t;
  if (state == State::separated) at.u << hover * within + speed, within * t;
  at.r *= size;
  return at;
}

PlantedCone finish(const Jacobian& jacobian, const VectorXd& inverse_mass, VectorXd friction,
                   const std::vector<Planted>& planted) {
  PlantedCone p;
  p.problem.delassus = jacobian * inverse_mass.asDiagonal() * Jacobian(jacobian.transpose());
  p.problem.friction = std::move(friction);
  const auto rows = static_cast<Eigen::Index>(3 * planted.size());
  p.impulse.resize(rows), p.velocity.resize(rows);
  for (std::size_t i = 0; i < planted.size(); ++i) {
    p.impulse.segment<3>(static_cast<Eigen::Index>(3 * i)) = planted[i].r;
    p.velocity.segment<3>(static_cast<Eigen::Index>(3 * i)) = planted[i].u;
  }
  p.problem.free_velocity = p.velocity - p.problem.delassus * p.impulse;
  return p;
}

/// Contacts in every state by turns, with the share of both_zero last.
std::vector<Planted> plant_all(FrictionLaw law, const VectorXd& friction, double both_zero, Random& random) {
  const auto contacts = static_cast<int>(friction.size());
  const int degenerate = static_cast<int>(std::lround(both_zero * contacts));
  std::vector<Planted> all;
  for (int i = 0; i < contacts; ++i) {
    const auto state = i >= contacts - degenerate ? State::both_zero : static_cast<State>(i % 3);
    all.push_back(plant(law, state, friction(i), random.between(0.5, 2), random));
  }
  return all;
}

VectorXd frictions(int contacts, Random& random) {
  return VectorXd::NullaryExpr(contacts, [&] { return random.between(0.1, 1); });
}

// Dense random rows.

struct Rows {
  int contacts = 10, coordinates = 40;
  double mass_decades = 0.3, both_zero = 0;
  bool duplicated = false;
};

PlantedCone dense(FrictionLaw law, std::uint64_t seed, const Rows& rows) {
  Random random(seed);
  MatrixXd j =
      MatrixXd::NullaryExpr(3 * rows.contacts, rows.coordinates, [&] { return random.between(-1, 1); });
  VectorXd friction = frictions(rows.contacts, random);
  if (rows.duplicated) {
    j.bottomRows(j.rows() / 2) = j.topRows(j.rows() / 2).eval();
    friction.tail(rows.contacts / 2) = friction.head(rows.contacts / 2).eval();
  }
  const VectorXd inverse_mass = VectorXd::NullaryExpr(
      rows.coordinates, [&] { return random.decades(-rows.mass_decades / 2, rows.mass_decades / 2); });
  auto planted = plant_all(law, friction, rows.both_zero, random);
  if (rows.duplicated)  // a pair shares its velocity
    for (std::size_t i = 0; i < planted.size() / 2; ++i) planted[i + planted.size() / 2] = planted[i];
  return finish(j.sparseView(), inverse_mass, std::move(friction), planted);
}

PlantedCone full_rank(FrictionLaw law, std::uint64_t seed) {
  return dense(law, seed, {});
}
PlantedCone redundant(FrictionLaw law, std::uint64_t seed) {
  return dense(law, seed, {.coordinates = 12});
}
PlantedCone duplicated(FrictionLaw law, std::uint64_t seed) {
  return dense(law, seed, {.duplicated = true});
}
PlantedCone both_zero(FrictionLaw law, std::uint64_t seed) {
  return dense(law, seed, {.both_zero = 0.2});
}
PlantedCone mass_ratio(FrictionLaw law, std::uint64_t seed) {
  return dense(law, seed, {.mass_decades = 4});
}

// Boxes: six coordinates a body, contacts at corners.

/// Body a is pushed along the normal by body b (-1: fixed) at arms from their centres.
struct Corner {
  int a, b;
  Vector3d arm_a, arm_b, normal;
};

Jacobian jacobian_of(const std::vector<Corner>& corners, int bodies) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < static_cast<int>(corners.size()); ++i) {
    const Corner& c = corners[static_cast<std::size_t>(i)];
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
  Jacobian j(static_cast<Eigen::Index>(3 * corners.size()), 6 * bodies);
  j.setFromTriplets(entries.begin(), entries.end());
  return j;
}

/// Unit cubes of these masses, kg.
VectorXd cube_inverse_mass(const std::vector<double>& mass) {
  VectorXd inverse(static_cast<Eigen::Index>(6 * mass.size()));
  for (std::size_t b = 0; b < mass.size(); ++b)
    inverse.segment<6>(static_cast<Eigen::Index>(6 * b)) << Vector3d::Constant(1 / mass[b]),
        Vector3d::Constant(6 / mass[b]);
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
    for (int k = b; k < boxes; ++k) above += mass[static_cast<std::size_t>(k)];
    const double mu = random.between(0.2, 0.8);
    const State state = random.between(0, 1) < 0.6 ? State::sticking : State::sliding;
    const Planted joint = plant(law, state, mu, 1, random);
    for (int corner = 0; corner < 4; ++corner) {
      const Vector3d at(corner % 2 - 0.5, corner / 2 - 0.5, 0);
      corners.push_back({b, b - 1, at - Vector3d(0, 0, 0.5), at + Vector3d(0, 0, 0.5), Vector3d::UnitZ()});
      planted.push_back({random.between(0.2, 0.3) * above * joint.r, joint.u});
      friction(4 * b + corner) = mu;
    }
  }
  return finish(jacobian_of(corners, boxes), cube_inverse_mass(mass), std::move(friction), planted);
}

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
      friction(static_cast<Eigen::Index>(corners.size())) = mu;
      corners.push_back(
          {0, -1, Vector3d(side / 2, corner % 2 - 0.5, corner / 2 - 0.5), Vector3d::Zero(), normal});
      planted.push_back(plant(law, State::sticking, mu, random.between(0.5, 2), random));
    }
  }
  return finish(jacobian_of(corners, 1), cube_inverse_mass({1}), std::move(friction), planted);
}

// Many bodies in a band.

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

std::span<const PlantedFamily> planted_families() {
  static constexpr std::array families{
      PlantedFamily{"full_rank", "10 contacts, 40 coordinates", full_rank},
      PlantedFamily{"redundant", "10 contacts, 12 coordinates", redundant},
      PlantedFamily{"duplicated", "5 contacts, each of them twice", duplicated},
      PlantedFamily{"both_zero", "a fifth of the contacts without impulse and velocity", both_zero},
      PlantedFamily{"mass_ratio", "masses from 1 to 1e4", mass_ratio},
      PlantedFamily{"two_boxes", "two cubes on each other", two_boxes},
      PlantedFamily{"heavy_top", "five cubes, each ten times as heavy as the one below", heavy_top},
      PlantedFamily{"wedge", "a cube between two walls, held by any squeeze", wedge},
  };
  return families;
}

PlantedCone planted_regular(FrictionLaw law, int contacts, std::uint64_t seed) {
  return band(law, contacts, 2 * contacts / 3, 0.3, 0, seed);
}
PlantedCone planted_hard(FrictionLaw law, int contacts, std::uint64_t seed) {
  return band(law, contacts, contacts / 3, 4, 0.05, seed);
}

}  // namespace pbd::reference
