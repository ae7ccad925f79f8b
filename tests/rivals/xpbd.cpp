// Steps by XPBD beside known answers, and beside Newton's: where it solves the step, and how far it ends from
// it elsewhere.
#include "rivals/xpbd.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <optional>
#include <string>

#include "mesh.h"
#include "rival_refusals.h"
#include "rivals/newton.h"
#include "scenes/standard.h"

using namespace pbd;
using namespace pbd::rivals;

namespace {

constexpr double xpbd_step_s = 1.0 / 60, sprung_gravity = 9.81;

/// Nodes of `mass` (kg) on a held one, each on a spring to the one before, at their places.
Scene sprung(const std::vector<Vec3>& places, double mass, double rest_length, double compliance) {
  Scene scene;
  add_node(scene, Vec3::Zero(), infinity);
  scene.effects.emplace_back(Gravity{});
  Distance springs;
  for (const Vec3& place : places) {
    const int node = add_node(scene, place, mass);
    springs.node.push_back({node - 1, node});
    springs.rest_length.push_back(rest_length);
    springs.compliance.push_back(compliance);
  }
  scene.effects.emplace_back(std::move(springs));
  return scene;
}

struct Ended {
  State state;
  Report report;
};

Ended ended(const Scene& scene, MakeRival make, double h, int iterations, double tolerance = 1e-12) {
  Ended found{scene.initial, {}};
  found.report = make(scene, h)->step(found.state, {tolerance, iterations});
  return found;
}

/// m, how far XPBD ends from Newton's solution of a step.
double beside(const Scene& scene, double h) {
  const Ended found = ended(scene, xpbd, h, 20000);
  CHECK(found.report.reason == "sweeps change nothing more");
  const Ended exact = ended(scene, newton, h, 100);
  CHECK(exact.report.status == Status::ok);
  return (found.state.x - exact.state.x).norm();
}

}  // namespace

TEST_CASE("one sweep of XPBD solves the step of one spring on a held node: its direction stays") {
  Scene scene = sprung({Vec3(0.7, -0.3, 0.4)}, 2, 0.5, GENERATE(1e-6, 1e-3, 1e-1));
  scene.initial.v.col(1) = Vec3(1, 2, -0.5);
  const Ended found = ended(scene, xpbd, xpbd_step_s, 1);
  const Ended exact = ended(scene, newton, xpbd_step_s, 100);
  CHECK(exact.report.status == Status::ok);
  CHECK((found.state.x - exact.state.x).norm() <= 1e-9 * (exact.state.x - scene.initial.x).norm());
  CHECK((found.state.v - exact.state.v).norm() <= 1e-9 * (exact.state.v - scene.initial.v).norm());
  CHECK(found.report.status == Status::ok);
  CHECK(found.report.iterations == 1);
}

TEST_CASE(
    "springs that hang at rest stay there by XPBD, stretched by compliance times weight, whatever the step") {
  constexpr double mass = 0.5, length = 0.2, compliance = 2e-3;
  constexpr int count = 5;
  std::vector<Vec3> places;
  double depth = 0;
  for (int k = 0; k < count; ++k) {
    depth += length + compliance * (count - k) * mass * sprung_gravity;
    places.emplace_back(0, 0, -depth);
  }
  const Scene scene = sprung(places, mass, length, compliance);
  for (const double h : {0.1, 1.0 / 60, 1e-3}) {
    const Ended found = ended(scene, xpbd, h, 20000, 0);
    CHECK((found.state.x - scene.initial.x).cwiseAbs().maxCoeff() <= 1e-12);
  }
}

TEST_CASE("a spring's amplitude falls by 1/sqrt(1 + (w h)^2) a step of XPBD, as by implicit Euler") {
  constexpr double mass = 0.5, length = 1, compliance = 1e-2;
  Scene scene = sprung({Vec3(0, 0, -length - compliance * mass * sprung_gravity)}, mass, length, compliance);
  const Vec3 rest = scene.initial.x.col(1);
  scene.initial.x(2, 1) -= 0.1;
  const double w = 1 / std::sqrt(compliance * mass), wh = w * xpbd_step_s;
  // v^2 + (w x)^2 falls by 1/(1 + (w h)^2) a step.
  const auto squared = [&](const State& state) {
    return state.v.col(1).squaredNorm() + std::pow(w * (state.x.col(1) - rest).norm(), 2);
  };
  State state = scene.initial;
  const auto rival = xpbd(scene, xpbd_step_s);
  for (int k = 0; k < 20; ++k) {
    const double before = squared(state);
    CHECK(rival->step(state, {0, 1}).iterations == 1);
    CHECK(squared(state) / before == Approx(1 / (1 + wh * wh)).epsilon(1e-10));
  }
}

TEST_CASE(
    "XPBD ends beside the step's solution, by the fourth order of the step where a chain begins at rest") {
  Scene scene = sprung({Vec3(0.3, 0, -0.1), Vec3(0.55, 0.1, -0.3), Vec3(0.6, 0.3, -0.5)}, 1, 0, 1e-9);
  auto& springs = std::get<Distance>(scene.effects[1]);
  for (std::size_t i = 0; i < springs.node.size(); ++i) {
    const auto& [a, b] = springs.node[i];
    springs.rest_length[i] = (scene.initial.x.col(b) - scene.initial.x.col(a)).norm();
  }
  const double near = beside(scene, 1.0 / 120), far = beside(scene, 1.0 / 60);
  CHECK(near > 1e-9);
  CHECK(std::log2(far / near) == Approx(4).margin(0.1));
}

TEST_CASE("XPBD ends nearer to a sheet's or solid's step than it begins, and says that it is beside it") {
  const auto nears = [](const Scene& scene) {
    const Ended exact = ended(scene, newton, xpbd_step_s, 100);
    CHECK(exact.report.status == Status::ok);
    const auto apart = [&](const Points& x) { return (x - exact.state.x).norm(); };
    std::optional<double> first;
    State state = scene.initial;
    const Report report = xpbd(scene, xpbd_step_s)->step(state, {1e-12, 3000}, [&](const Iterate& iterate) {
      if (!first) first = apart(iterate.x);
    });
    CHECK(apart(state.x) < *first);
    CHECK(report.status == Status::not_converged);
  };
  for (const Strain strain : {Strain::green, Strain::corotational, Strain::linear})
    nears(pbdcheck::cantilever(8, {1e5, 0.3}, strain));
  nears(pbdcheck::cloth(4, false));
}

TEST_CASE("XPBD refuses what it cannot do in its own name") {
  Scene scene = sprung({Vec3(1, 0, 0)}, 1, 1, 0);
  CHECK(test::refusal(xpbd, scene, 0.01) ==
        "xpbd: distance compliance[0]: got 0; allowed: a number > 0: no hard constraints");
  CHECK(test::refusal(xpbd, scene, 0).rfind("xpbd: h: got 0", 0) == 0);
  std::get<Distance>(scene.effects[1]).node[0] = {0, 99};
  CHECK(test::refusal(xpbd, scene, 0.01).find("a node index") != std::string::npos);
}
