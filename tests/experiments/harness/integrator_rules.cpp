#include "harness/integrator_rules.h"
#include "harness/probes.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "scenes/standard.h"
#include "step/integrators.h"
#include "studies/time/energy.h"

using namespace pbdcheck;

TEST_CASE("every integrator is a rule, newmark one for each alpha") {
  const auto rules = integrator_rules({0.5, 0.7});
  CHECK(rules.size() == pbd::integrators().size() + 1);
  for (const auto& integrator : pbd::integrators()) {
    INFO(integrator.name);
    const auto rule = std::find_if(rules.begin(), rules.end(), [&](const Rule& each) {
      return each.method.integrator == integrator.name && !(each.alpha() == 0.5);
    });
    REQUIRE(rule != rules.end());
    CHECK(rule->order == integrator.order);
    CHECK(std::isnan(rule->alpha()) == (integrator.name != "newmark"));
  }
  const auto trapezoid =
      std::find_if(rules.begin(), rules.end(), [](const Rule& each) { return each.alpha() == 0.5; });
  REQUIRE(trapezoid != rules.end());
  CHECK(trapezoid->order == 2);
  CHECK(trapezoid->marginal);
  CHECK(trapezoid->name() == "newmark 0.5");
}

TEST_CASE("what steps miss their tolerance by is told, 0 where none does") {
  const pbd::Scene scene = pendulum(1, 0);
  pbd::Method method;
  const auto keep = [](const pbd::State&, const pbd::State&) { return ""; };
  CHECK(simulate_steps(scene, method, 0.01, 10, keep).missed_residual == 0);
  method.max_outer = 1;
  const auto missed = simulate_steps(scene, method, 0.1, 10, keep);
  REQUIRE(missed.steps_ok < 10);
  CHECK(missed.missed_residual > method.tolerance);
  CHECK(missed.missed_residual < 1);
}

TEST_CASE("a simulation does its steps, or ends as diverged with the reason given") {
  const pbd::Scene scene = pendulum(1, 0);
  int seen = 0;
  const auto whole =
      simulate_steps(scene, {}, 0.01, 10, [&](const pbd::State& before, const pbd::State& after) {
        CHECK(after.time == Approx(0.01 * ++seen));
        CHECK(before.time == Approx(after.time - 0.01).margin(1e-15));
        return "";
      });
  CHECK(seen == 10);
  CHECK(whole.steps == 10);
  CHECK(whole.steps_ok == 10);
  CHECK(whole.status == pbd::Status::ok);
  CHECK(whole.end.time == Approx(0.1));
  const auto ended = simulate_steps(scene, {}, 0.01, 10, [&](const pbd::State&, const pbd::State& after) {
    return after.time > 0.025 ? "far enough" : "";
  });
  CHECK(ended.steps == 3);
  CHECK(ended.status == pbd::Status::diverged);
  CHECK(ended.reason == "far enough");
}

TEST_CASE("scales and momenta are those of the formulas") {
  pbd::Scene scene;
  pbd::add_node(scene, {1, 0, 0}, 2, {0, 3, 0});
  pbd::add_node(scene, {0, 0, 4}, 1, {0, 0, -1});
  pbd::add_node(scene, {0, 0, 0}, pbd::infinity, {7, 7, 7});
  CHECK(linear_momentum(scene, scene.initial) == pbd::Vec3(0, 6, -1));
  CHECK(angular_momentum(scene, scene.initial) == pbd::Vec3(0, 0, 6));
  CHECK(momentum_scale(scene, scene.initial) == 7);
  CHECK(energy_scale(scene) == Approx(9.5));
  scene.effects.emplace_back(pbd::Gravity{{0, 0, -10}});
  CHECK(energy_scale(scene) == Approx(9.5 + 30 * std::sqrt(17.0)));
  CHECK(total_energy(scene, scene.initial) == Approx(9.5 + 40));
}

TEST_CASE("the free bodies are held by nothing") {
  for (const pbd::Scene& scene : {free_links(0), free_net(), free_beam(2, 1e5)}) {
    for (const double mass : scene.mass) CHECK(std::isfinite(mass));
    for (const auto& effect : scene.effects) {
      CHECK_FALSE(std::holds_alternative<pbd::Gravity>(effect));
      CHECK_FALSE(std::holds_alternative<pbd::Anchor>(effect));
    }
    CHECK(linear_momentum(scene, scene.initial).norm() > 0.01);
    CHECK(angular_momentum(scene, scene.initial).norm() > 0.01);
  }
}
