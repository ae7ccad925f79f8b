// Velocities of the convex law against those that are planted.
#include "cones/velocity_share.h"

#include <catch2/catch.hpp>

#include "planted_cones.h"

using namespace pbdcheck;
using namespace pbd::reference;

TEST_CASE("a velocity that is off by more than its residual allows is seen, on every planted family") {
  for (const auto& family : planted_families()) {
    const PlantedCone planted = family.draw(FrictionLaw::cone, 1);
    ConeSolution exact, wrong;
    exact.impulse = wrong.impulse = planted.impulse;
    exact.velocity = wrong.velocity = planted.velocity;
    CHECK(velocity_share(planted.problem, exact, exact, 0) == 0);
    wrong.velocity[0] += 1e-6 * planted.problem.free_velocity.norm();
    CHECK(velocity_share(planted.problem, exact, wrong, 1e-10) > 1);
  }
}
