// Contact problems whose solution is known because it was planted.
//
// Draw r* and u~* complementary, contact by contact (sticking, sliding, separated, or both zero), and W = J
// M^-1 J^T; then q := u* - W r*. u* is the only velocity that solves the law `cone`; r* is not the only
// impulse where W is singular, and Coulomb's law may have other solutions.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "cone_problem.h"

namespace pbd::reference {

struct PlantedCone {
  ConeProblem problem;
  Eigen::VectorXd impulse, velocity;  // r*, N s, and u*, m/s
};

/// Small ones, 8 to 20 contacts, by what is hard about them.
struct PlantedFamily {
  std::string_view name;
  std::string_view text;
  PlantedCone (*draw)(FrictionLaw law, std::uint64_t seed);
};
std::span<const PlantedFamily> planted_families();
inline constexpr int planted_seeds = 25;  // problems of each family that experiments and tests use: 1 .. 25

/// Sparse ones of any number of contacts, bodies of six coordinates in a band.
/// regular: masses 1 to 2, W of full rank. hard: masses 1 to 1e4, more rows than coordinates, 5 % of the
/// contacts with r* = u* = 0.
PlantedCone planted_regular(FrictionLaw law, int contacts, std::uint64_t seed);
PlantedCone planted_hard(FrictionLaw law, int contacts, std::uint64_t seed);

}  // namespace pbd::reference
