// Steps of deformables as contact problems with elastic rows behind the contacts.
#include "studies/iteration/dual_trace.h"

#include <catch2/catch.hpp>

#include "cones/cone_relaxations.h"
#include "studies/iteration/deformable_contacts.h"

using namespace pbdcheck;
using namespace pbd::reference;

TEST_CASE(
    "steps of deformables in contact are solved by the judge, and by direct where it says so, elastic rows "
    "among them") {
  int solved = 0;
  for (const DeformableContact& each : deformable_contacts()) {
    INFO(each.name);
    const DualCase of = dual_case(each.name, each.scene, each.h, FrictionLaw::cone);
    REQUIRE(of.problem.contacts() >= 4);
    REQUIRE(of.problem.bounded() > 0);
    REQUIRE(of.impulse.allFinite());
    DualTrace trace(of);
    trace.add(0, of.scale.cwiseProduct(of.impulse));
    CHECK(trace.samples.back().residual <= 1e-10);
    CHECK(trace.samples.back().error <= 1e-12);
    const ConeProblem rows = cone_problem(of.step.rows, of.step.v_free);
    const ConeSolution direct =
        relax_cone("direct", of.step.rows, of.step.v_free, {rows, of.law, 1e-10, 200});
    if (direct.outcome != Outcome::ok) continue;
    ++solved;
    trace.add(1, direct.impulse);
    CHECK(trace.samples.back().residual <= 1e-8);
    CHECK(trace.samples.back().error <= 1e-6);
  }
  CHECK(solved > 0);
}
