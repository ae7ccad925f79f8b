// Steps of deformable surfaces in contact with each other that have a closed form.
#include <catch2/catch.hpp>
#include <cmath>

#include "judged_contact.h"
#include "side_by_side.h"

using namespace pbd;
using namespace pbd::reference;
using namespace pbd::test;

TEST_CASE("the judge stops edges that meet side by side in one plane by their ends") {
  const double leaning = GENERATE(0.0, 5e-4), gap = 5e-3;
  const Scene scene = side_by_side(leaning);
  const auto j = judged(scene);
  CHECK(std::abs(j.v(0, 0) - gap / judged_step_s) <= by_hand);
  CHECK(std::abs(j.v(0, 1) - (gap + leaning) / judged_step_s) <= by_hand);
  CHECK(std::abs(j.v(0, 2) - 0.6) <= by_hand);
}
