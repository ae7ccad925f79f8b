// Steps of deformable surfaces in contact with each other that have a closed form.
#include <catch2/catch.hpp>
#include <cmath>

#include "cone_interior_point.h"
#include "contact_newton.h"
#include "side_by_side.h"

using namespace pbd;
using namespace pbd::reference;
using pbd::test::side_by_side;

TEST_CASE("the judge stops edges that meet side by side in one plane by their ends") {
  const double leaning = GENERATE(0.0, 5e-4), gap = 5e-3, step_s = 0.01, closed = 1e-10;
  const Scene scene = side_by_side(leaning);
  const auto j = contact_newton(scene, scene.initial, step_s, Friction::coulomb, cone_interior_point);
  CHECK(j.outcome == Outcome::ok);
  CHECK(std::abs(j.v(0, 0) - gap / step_s) <= closed);
  CHECK(std::abs(j.v(0, 1) - (gap + leaning) / step_s) <= closed);
  CHECK(std::abs(j.v(0, 2) - 0.6) <= closed);
}
