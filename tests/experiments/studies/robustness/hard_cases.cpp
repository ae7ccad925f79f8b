#include "studies/robustness/hard_cases.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "error.h"
#include "scenes/standard.h"
#include "studies/robustness/gates.h"
#include "studies/robustness/generated.h"
#include "studies/robustness/units.h"
#include "validate.h"

using namespace pbdcheck;

TEST_CASE("every hard case and generated scene is a valid scene, the same each time") {
  for (const auto& each : hard_cases(false)) CHECK_NOTHROW(pbd::validate(each.scene));
  for (int i = 0; i < 50; ++i) {
    const auto once = generated_case(i), again = generated_case(i);
    CHECK_NOTHROW(pbd::validate(once.scene));
    CHECK(once.scene.initial.x == again.scene.initial.x);
    CHECK(once.h == again.h);
  }
}

TEST_CASE("other units change the numbers, not the motion") {
  const pbd::Scene scene = chain(5);
  const pbd::Scene scaled = in_units(scene, 2, 8);
  pbd::Method method;
  pbd::Workspace a(scene, method), b(scaled, method);
  pbd::State usual = scene.initial, other = scaled.initial;
  for (int k = 0; k < 3; ++k) {
    pbd::step(a, 0.01, usual);
    pbd::step(b, 0.01, other);
  }
  CHECK((other.x / 2 - usual.x).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("a hanging rope passes its gates, and a gate sees what is wrong") {
  HardCase each{"rope", chain(2), 0.01, 1, std::numeric_limits<double>::infinity()};
  for (int node = 0; node < 3; ++node) each.scene.initial.x.col(node) = pbd::Vec3(0, 0, -0.5 * node);
  each.tension = true;
  pbd::Method method;
  const auto good = simulate(each, method, each.h, {10, 10, 3});
  CHECK(good.all_hold());
  CHECK(good.steps_ok == 10);
  each.scene.initial.v.col(2) = pbd::Vec3(1, 0, 0);  // it swings, and does not settle
  const auto swinging = simulate(each, method, each.h, {10, 10, 3});
  CHECK_FALSE(swinging.all_hold());
}
