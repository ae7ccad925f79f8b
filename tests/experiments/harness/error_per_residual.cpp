#include <catch2/catch.hpp>
#include <cmath>

#include "harness/rows_of_step.h"
#include "scenes/standard.h"

using namespace pbdcheck;

TEST_CASE("what a residual may be of an error follows from the least eigenvalue of the dual matrix") {
  // Straight links of equal masses: N has 2/m on its diagonal and -1/m beside it, so that beside its blocks
  // the eigenvalues of n links are 1 - cos(k pi/(n + 1)).
  for (const int links : {1, 2, 5}) {
    const pbd::Scene scene = chain(links, 1, true);
    const double least = 1 - std::cos(std::acos(-1.0) / (links + 1));
    const double found =
        error_per_residual(scene, scene.initial, scene.initial, 0.01, pbd::Friction::coulomb);
    CHECK(std::abs(found - (1 + 1 / std::sqrt(least))) <= 1e-9 * found);
  }
}
