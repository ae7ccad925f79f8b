// Steps that the judge of contact is to solve. SI units.
#pragma once

#include <catch2/catch.hpp>

#include "cone_interior_point.h"
#include "contact_newton.h"
#include "scenes/contacts.h"

namespace pbd::test {

using pbdcheck::gravity;

inline constexpr double judged_step_s = 0.01;
inline constexpr double by_hand = 1e-10;  // m/s, what a judge's step may be off one known by hand

/// Checks that it is solved.
inline reference::ContactJudgement judged(const Scene& scene, const State& state,
                                          Friction friction = Friction::coulomb,
                                          reference::ConeSolver solver = reference::cone_interior_point,
                                          const reference::ContactStart& start = {}) {
  auto j = reference::contact_newton(scene, state, judged_step_s, friction, solver, start);
  INFO(j.reason);
  CHECK(j.outcome == reference::Outcome::ok);
  return j;
}
inline reference::ContactJudgement judged(const Scene& scene, Friction friction = Friction::coulomb,
                                          reference::ConeSolver solver = reference::cone_interior_point) {
  return judged(scene, scene.initial, friction, solver);
}

}  // namespace pbd::test
