// Steps of deformable surfaces in contact with each other that have a closed form.
#include <catch2/catch.hpp>
#include <cmath>

#include "judged_contact.h"
#include "pressed_surfaces.h"
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

TEST_CASE("the judge parts surfaces in each other by a tenth of their thickness in a step") {
  PressedSurfaces pressed(GENERATE(Pressing::node, Pressing::edge), {.friction = 0.3});
  pressed.sink();
  const auto j = judged(pressed.scene);
  for (const int node : pressed.nodes)
    CHECK((Vec3(j.v.col(node)) - pressed.after_sinking()).norm() <= by_hand);
}

TEST_CASE("the judge lets surfaces and spheres on them rub and yield by the law of their two materials") {
  const auto pressing = GENERATE(Pressing::node, Pressing::edge, Pressing::sphere);
  const double compliance = GENERATE(0.0, 1e-4);
  const PressedSurfaces pressed(pressing, {.friction = 0.3, .compliance = compliance});
  static_assert(PressedSurfaces::h == judged_step_s);
  const auto j = judged(pressed.scene);
  INFO("case " << static_cast<int>(pressing) << ", compliance " << compliance);
  for (const int node : pressed.nodes) CHECK((Vec3(j.v.col(node)) - pressed.after()).norm() <= by_hand);
}
