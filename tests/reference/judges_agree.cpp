// Agreement of the judges where a step has no closed form, and what they make of hard, redundant and
// contradictory constraints.
#include <catch2/catch.hpp>
#include <cmath>

#include "judge.h"
#include "judged_scenes.h"
#include "nonlinear.h"
#include "primal_newton.h"

using namespace pbd;
using namespace pbd::reference;
using namespace pbd::test;

namespace {

/// Sheet of n x n cells, saddle-shaped so that hard links are independent, held at two corners.
Scene saddle_cloth(int n, double compliance) {
  TriangleMesh mesh = grid_sheet({n, n}, {1, 1});
  for (int i = 0; i < mesh.x.cols(); ++i)
    mesh.x(2, i) = 0.2 * std::pow(mesh.x(0, i) - 0.5, 2) - 0.3 * std::pow(mesh.x(1, i) - 0.3, 2);
  Scene scene;
  add_sheet_nodes(scene, mesh, 0.2);
  scene.mass[0] = scene.mass[n] = infinity;
  scene.effects = {Gravity{}, sheet_links(mesh, 0, compliance), sheet_bending(mesh, 0, 100)};
  return scene;
}

/// Both judges reach a certified minimum and agree to 1e-9 of the step's displacement.
void check_agreement(const Scene& scene, double h) {
  const Judgement newton = primal_newton(scene, scene.initial, h), other = ipopt(scene, scene.initial, h);
  INFO(newton.reason << newton.note << " / " << other.reason);
  REQUIRE(newton.outcome == Outcome::ok);
  REQUIRE(other.outcome == Outcome::ok);
  CHECK(newton.certified);
  CHECK(newton.correction <= 1e-11);
  CHECK(newton.infeasible <= 1e-12);
  CHECK(relative(newton.x, other.x, scene.initial.x) <= 1e-9);
  CHECK(relative(newton.x, scene.initial.x + h * newton.v, scene.initial.x) <= 1e-12);
  if (newton.multiplier.size() > 0)
    CHECK((newton.multiplier - other.multiplier).norm() <= 1e-6 * newton.multiplier.norm());
}

}  // namespace

TEST_CASE("the judges agree on chains") {
  for (const int links : {1, 10, 20, 50, 100})
    for (const double ratio : {1.0, 100.0})
      for (const double h : {1.0 / 30, 1.0 / 240}) check_agreement(swinging_chain(links, ratio), h);
}

TEST_CASE("the judges agree on solids of every strain") {
  for (const Strain strain : {Strain::green, Strain::corotational, Strain::linear})
    for (const int n : {8, 12})
      for (const double young : {1e5, 1e7}) check_agreement(cantilever(n, young, 0.3, strain), 1.0 / 60);
  check_agreement(cantilever(8, 1e6, 0.4999, Strain::green), 1.0 / 60);
}

TEST_CASE("the judges agree on cloth") {
  check_agreement(saddle_cloth(20, 0), 1.0 / 60);
  check_agreement(saddle_cloth(20, 1e-5), 1.0 / 60);
  const TriangleMesh mesh = grid_sheet({8, 8}, {1, 1});
  Scene membrane;
  add_sheet_nodes(membrane, mesh, 0.2);
  membrane.mass[0] = membrane.mass[8] = infinity;
  membrane.effects = {Gravity{}, sheet_strain(mesh, 0, {1e5, 0.3}, 1e-3), sheet_bending(mesh, 0, 100)};
  check_agreement(membrane, 1.0 / 60);
}

TEST_CASE("Newton holds for heavy tips, long and short steps, and through a swing") {
  for (const int links : {20, 100})
    for (const double ratio : {1000.0, 1e4})
      for (const double h : {1.0 / 30, 1.0 / 480}) {
        const Scene scene = swinging_chain(links, ratio);
        const Judgement j = primal_newton(scene, scene.initial, h);
        CHECK(j.outcome == Outcome::ok);
        CHECK(j.certified);
        CHECK(j.residual <= 1e-11);
        CHECK(j.infeasible <= 1e-12);
      }
  const Scene scene = swinging_chain(20, 1000);
  State state = scene.initial;
  for (int frame = 0; frame < 60; ++frame) {
    const Judgement j = primal_newton(scene, state, 1.0 / 60);
    REQUIRE(j.outcome == Outcome::ok);
    REQUIRE(j.certified);
    state.x = j.x, state.v = j.v;
  }
}

TEST_CASE("redundant constraints are found and share the multipliers of single ones") {
  const double h = 1.0 / 60;
  Scene scene = swinging_chain(5, 10);
  const Judgement single = primal_newton(scene, scene.initial, h);
  CHECK(single.rank == 5);
  scene.effects.push_back(scene.effects[1]);
  const Judgement doubled = primal_newton(scene, scene.initial, h);
  REQUIRE(doubled.outcome == Outcome::ok);
  CHECK(doubled.rank == 5);
  CHECK(doubled.note.find("redundant") != std::string::npos);
  CHECK(relative(single.x, doubled.x, scene.initial.x) <= 1e-12);
  for (int i = 0; i < 5; ++i) {
    CHECK(doubled.multiplier(i) == Approx(single.multiplier(i) / 2).epsilon(1e-9));
    CHECK(doubled.multiplier(i + 5) == Approx(single.multiplier(i) / 2).epsilon(1e-9));
  }
  CHECK(relative(ipopt(scene, scene.initial, h).x, single.x, scene.initial.x) <= 1e-9);
}

TEST_CASE("contradictory constraints are not passed off as solved") {
  for (const double factor : {1.1, 1 + 1e-6}) {
    Scene scene = swinging_chain(2, 1);
    Distance longer = std::get<Distance>(scene.effects[1]);
    longer.rest_length[1] *= factor;
    scene.effects.emplace_back(longer);
    for (const NamedJudge& named : judges()) {
      INFO(named.name << " " << factor);
      const Judgement j = named.judge(scene, scene.initial, 1.0 / 60);
      CHECK(j.outcome != Outcome::ok);
      CHECK_FALSE(j.reason.empty());
    }
  }
}
