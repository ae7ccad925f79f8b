#include "studies/robustness/hard_cases.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "error.h"
#include "scenes/standard.h"
#include "studies/robustness/gates.h"
#include "studies/robustness/generated.h"
#include "studies/robustness/units.h"
#include "validate.h"

using namespace pbdcheck;

namespace {

std::vector<std::string> failing(const Simulated& simulated) {
  std::vector<std::string> names;
  for (const Gate& gate : simulated.gates)
    if (gate.fails()) names.emplace_back(gate.name);
  return names;
}

}  // namespace

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
  CHECK(all_hold(good.gates));
  CHECK(good.steps_ok == 10);
  each.scene.initial.v.col(2) = pbd::Vec3(1, 0, 0);  // it swings, and does not settle
  const auto swinging = simulate(each, method, each.h, {10, 10, 3});
  CHECK(failing(swinging) == std::vector<std::string>{"settles", "tension"});
}

namespace {

/// Swings, and is asked for nothing but what every case is.
HardCase swinging_rope(int links) {
  HardCase each{"rope", chain(links), 0.01, 1};
  for (int node = 0; node <= links; ++node) each.scene.initial.x.col(node) = pbd::Vec3(node, 0, 0) / links;
  each.slowest = 0;
  return each;
}

}  // namespace

TEST_CASE("a method that gives up early fails the gate of hard rows, and says ok of no step") {
  pbd::Method method;
  method.outer = "plain";
  method.relaxation = "gauss_seidel";
  method.max_outer = method.max_sweeps = 1;
  const auto early = simulate(swinging_rope(20), method, 0.05, {40, 40, 3});
  const auto names = failing(early);
  CHECK(std::count(names.begin(), names.end(), "hard_rows") == 1);
  CHECK(early.steps_ok == 0);
}

TEST_CASE("a step that says ok and ended elsewhere fails the gate of claims") {
  const HardCase each = swinging_rope(5);
  pbd::Method method;
  pbd::Workspace workspace(each.scene, method);
  pbd::State end = each.scene.initial;
  REQUIRE(pbd::step(workspace, each.h, end).status == pbd::Status::ok);
  const auto share = [&] {
    return claim_share(pbd::reference::residual_of(each.scene, each.scene.initial, each.h, end),
                       method.tolerance);
  };
  CHECK(share() <= 1);
  end.x(2, 3) += 1e-8;  // m, of a rope of 1 m: a hundred times 1e-8 h g, which the tolerance allows at most
  end.v(2, 3) += 1e-8 / each.h;
  CHECK(share() > 1);
  end.x(2, 3) = std::nan("");
  CHECK_FALSE(share() <= 1);
}

TEST_CASE("an iteration that only leads away fails the gate of residuals") {
  pbd::Method method;
  method.outer = "incremental";  // its point is not the step's: it comes to that, and no nearer
  method.relaxation = "direct";
  method.max_outer = 2;
  const auto names = failing(simulate(swinging_rope(5), method, 0.2, {3, 3, 0}));
  CHECK(std::count(names.begin(), names.end(), "residual") == 1);
}

TEST_CASE("a state that ceases to be finite fails its gate") {
  HardCase each = swinging_rope(2);
  for (auto& effect : each.scene.effects)
    if (auto* links = std::get_if<pbd::Distance>(&effect)) links->compliance.assign(2, 1e-8);
  pbd::Method method;
  method.integrator = "symplectic_euler";  // w h = 1e3: it grows a millionfold a step
  const auto names = failing(simulate(each, method, 0.05, {60, 60, 0}));
  CHECK(std::count(names.begin(), names.end(), "finite") == 1);
}

TEST_CASE("a motion that blows up fails the gate of the energy") {
  HardCase each = swinging_rope(2);
  for (auto& effect : each.scene.effects)
    if (auto* links = std::get_if<pbd::Distance>(&effect)) links->compliance.assign(2, 1e-4);
  pbd::Method method;
  method.integrator = "symplectic_euler";  // unstable for w h > 2
  const auto wild = simulate(each, method, 0.05, {40, 40, 0});
  const auto names = failing(wild);
  CHECK(std::count(names.begin(), names.end(), "energy") == 1);
}

TEST_CASE("a shape that is not recovered fails its gate") {
  HardCase each{"rope", chain(2), 0.01, 1, std::numeric_limits<double>::infinity()};
  for (int node = 0; node < 3; ++node) each.scene.initial.x.col(node) = pbd::Vec3(0, 0, -0.5 * node);
  each.rest = each.scene.initial.x;
  CHECK(failing(simulate(each, {}, each.h, {10, 10, 3})).empty());
  each.rest(2, 1) -= 1e-4;
  CHECK(failing(simulate(each, {}, each.h, {10, 10, 3})) == std::vector<std::string>{"recovers"});
}

TEST_CASE("a gate holds from 0 to its bound, and its bound is the one that is documented") {
  for (const double good : {0.0, 0.01}) CHECK(Gate{"energy", good, 0.01}.holds());
  for (const double bad : {0.0101, -1.0, std::nan("")}) {
    const Gate wrong{"energy", bad, 0.01};
    CHECK((wrong.fails() && !wrong.holds()));
  }
  const Gate skipped{"energy", 1, 0.01, "not asked"};
  CHECK((!skipped.fails() && !skipped.holds()));

  HardCase each{"rope", chain(2), 0.01, 1, std::numeric_limits<double>::infinity()};
  for (int node = 0; node < 3; ++node) each.scene.initial.x.col(node) = pbd::Vec3(0, 0, -0.5 * node);
  each.tension = true;
  each.rest = each.scene.initial.x;
  std::map<std::string_view, double> bounds;
  for (const Gate& found : simulate(each, {}, each.h, {10, 10, 3}).gates) bounds[found.name] = found.bound;
  CHECK(bounds == std::map<std::string_view, double>{{"finite", 0},
                                                     {"energy", 1e-2},
                                                     {"hard_rows", 1e-3},
                                                     {"claims", 1},
                                                     {"residual", 0},
                                                     {"settles", 1e-6},
                                                     {"tension", 1e-3},
                                                     {"recovers", 1e-6}});
}
