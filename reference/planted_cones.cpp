#include "planted_cones.h"

#include "planted_draw.h"

namespace pbd::reference {
namespace {

using namespace planted;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Dense random rows.
struct RowsOfCones {
  int contacts = 10, coordinates = 40;
  double mass_decades = 0.3, both_zero = 0;
  bool duplicated = false;
};

PlantedCone dense(FrictionLaw law, std::uint64_t seed, const RowsOfCones& rows) {
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

}  // namespace pbd::reference
