// The augmented Lagrangian on rows of steps where contacts stick, slide and open, and joints hold.
#include "augmented.h"

#include <catch2/catch.hpp>

#include "rows_of_step.h"
#include "scenes/contacts.h"
#include "semismooth.h"

using namespace pbd;
using namespace pbdcheck;

TEST_CASE("the augmented Lagrangian solves the convex law's rows, from any impulses") {
  const LinearStep step = linear_step(pile(), pile().initial, 0.01, Friction::cone);
  REQUIRE(AugmentedLagrangian::applies(step.rows));
  for (const double start : {0.0, 0.3}) {
    Rows rows = step.rows;
    for_each_block(rows.blocks, [&](auto& block) {
      for (auto& impulse : block.impulse) impulse.setConstant(start);
    });
    Points v = step.v_free;
    apply_impulses(rows, v);
    const double first = natural_residual(rows, v);
    AugmentedLagrangian augmented;
    for (int k = 0; k < 3; ++k) CHECK(augmented.improve(rows, v) > 0);
    CHECK(natural_residual(rows, v) < 1e-9 * first);
    Points rebuilt = step.v_free;
    apply_impulses(rows, rebuilt);
    CHECK((rebuilt - v).norm() < 1e-12 * v.norm());
  }
}

TEST_CASE("its fixed point of the slips is Coulomb's law, which another friction does not obey") {
  const LinearStep step = linear_step(pile(), pile().initial, 0.01, Friction::coulomb);
  Rows rows = step.rows;
  Points v = step.v_free;
  const double first = natural_residual(rows, v);
  AugmentedLagrangian augmented;
  for (int k = 0; k < 50; ++k) augmented.improve(rows, v);
  CHECK(natural_residual(rows, v) < 1e-8 * first);
  for_each_block(rows.blocks, []<class Block>(Block& block) { block.law = Friction::cone; });
  CHECK(natural_residual(rows, v) > 1e-4 * first);
}

TEST_CASE("the augmented Lagrangian leaves the law box to others") {
  CHECK_FALSE(AugmentedLagrangian::applies(linear_step(pile(), pile().initial, 0.01, Friction::box).rows));
}
