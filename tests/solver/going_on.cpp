// A workspace that goes on from another one's step.
#include <catch2/catch.hpp>

#include "oscillator.h"
#include "scenes/contacts.h"
#include "step/integrators.h"

using namespace pbd;
using namespace pbd::test;

namespace {

/// How far the fourth step ends from where one workspace ends that makes them all (m and m/s), if another one
/// with the same method goes on from the third.
double apart(const Scene& scene, const Method& method) {
  constexpr double h = 0.01;
  Workspace whole(scene, method), another(scene, method);
  State state = scene.initial;
  for (int k = 0; k < 3; ++k) CHECK(step(whole, h, state).status == Status::ok);
  State end = state;
  another.go_on_from(whole);
  CHECK(step(whole, h, state).status == Status::ok);
  CHECK(step(another, h, end).status == Status::ok);
  return std::max((end.x - state.x).cwiseAbs().maxCoeff(), (end.v - state.v).cwiseAbs().maxCoeff());
}

}  // namespace

TEST_CASE("a workspace that goes on from another one's step ends where that one does") {
  constexpr double rounding = 1e-11;  // of 1 m and some m/s, at a tolerance of 1e-13
  const Scene springs = spring(30, 0.2, 0.01), sliding = pbdcheck::sliding_box(0.2, 0.3, 1);
  for (const Integrator& integrator : integrators()) {
    INFO(integrator.name);
    const Method method = method_of(integrator.name);
    CHECK(apart(springs, method) <= rounding);
    if (integrator.contact) CHECK(apart(sliding, method) <= rounding);
  }
}

TEST_CASE("a workspace does not go on from another integrator's step") {
  const Scene scene = spring(30, 0.2);
  Workspace one(scene, method_of("bdf2")), other(scene, method_of("newmark"));
  CHECK_THROWS_WITH(one.go_on_from(other), Catch::Contains("bdf2") && Catch::Contains("newmark"));
}
