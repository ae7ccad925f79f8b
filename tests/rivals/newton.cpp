// Steps by Newton against the judge, and what the rival refuses.
#include "rivals/newton.h"

#include <catch2/catch.hpp>
#include <string>

#include "error.h"
#include "mesh.h"
#include "primal_newton.h"
#include "scenes/standard.h"

using namespace pbd;
using namespace pbd::rivals;
using pbdcheck::cantilever;

namespace {

constexpr double h = 1.0 / 60;

double relative(const Points& a, const Points& b, const Points& start) {
  return (a - b).cwiseAbs().maxCoeff() / (b - start).cwiseAbs().maxCoeff();
}

/// A few steps by the rival, each equal to the judge's.
void check_steps(const Scene& scene, int steps = 3) {
  const auto rival = newton(scene, h);
  State state = scene.initial;
  for (int i = 0; i < steps; ++i) {
    const State before = state;
    const auto judged = reference::primal_newton(scene, before, h);
    const Report report = rival->step(state, {.tolerance = 1e-12, .max_iterations = 200});
    INFO(report.reason << " after " << report.iterations << ", residual " << report.residual);
    REQUIRE(judged.outcome == reference::Outcome::ok);
    CHECK(report.status == Status::ok);
    CHECK(relative(state.x, judged.x, before.x) <= 1e-10);
    CHECK(relative(before.x + h * state.v, judged.x, before.x) <= 1e-10);
    CHECK(state.time == before.time + h);
  }
}

/// Sheet whose held edge moves, with an anchor and a force.
Scene sheet(bool links, bool triangles, bool hinges) {
  const TriangleMesh mesh = grid_sheet({4, 3}, {1, 0.7});
  Scene scene;
  const int first = add_sheet_nodes(scene, mesh, 0.2);
  pbdcheck::clamp_smallest_x(scene);
  scene.effects.emplace_back(Gravity{});
  scene.effects.emplace_back(ExternalForce{.node = {5, 0}, .force = {Vec3(1, 2, 3), Vec3(1, 1, 1)}});
  scene.effects.emplace_back(Anchor{.node = {9}, .target = {Vec3(1, 0.1, 0.2)}, .compliance = {1e-3}});
  if (links) scene.effects.emplace_back(sheet_links(mesh, first, 1e-4));
  if (triangles) scene.effects.emplace_back(sheet_strain(mesh, first, {1e6, 0.3}, 1e-3));
  if (hinges) scene.effects.emplace_back(sheet_bending(mesh, first, 1e2));
  scene.initial.v.row(1).setConstant(0.3);
  return scene;
}

std::string refusal(const Scene& scene, double step = h) {
  try {
    newton(scene, step);
  } catch (const SetupError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("steps of cantilevers equal the judge's") {
  for (const Strain strain : {Strain::green, Strain::corotational, Strain::linear})
    for (const double young : {1e5, 1e6, 1e7})
      for (const double poisson : {0.3, 0.49}) {
        INFO(strain_names[static_cast<std::size_t>(strain)] << " " << young << " " << poisson);
        check_steps(cantilever(8, {young, poisson}, strain));
      }
}

TEST_CASE("stiffness that is not positive definite is projected") {
  const int cells = GENERATE(4, 16);  // simplicial and supernodal
  for (const Strain strain : {Strain::green, Strain::corotational}) {
    INFO(strain_names[static_cast<std::size_t>(strain)] << " " << cells);
    Scene scene = cantilever(cells, {1e7, 0.3}, strain);
    scene.initial.x.row(0) *= 0.4;
    scene.initial.x.row(1) += 0.1 * scene.initial.x.row(0).cwiseAbs2();
    const auto rival = newton(scene, h);
    State state = scene.initial;
    const Report report = rival->step(state, {.tolerance = 1e-11, .max_iterations = 300});
    INFO(report.reason << " after " << report.iterations);
    CHECK(report.status == Status::ok);
    CHECK(report.factorisations > report.iterations);
  }
}

TEST_CASE("steps of sheets equal the judge's") {
  check_steps(sheet(true, false, false));
  check_steps(sheet(false, true, false));
  check_steps(sheet(true, false, true));
  check_steps(sheet(false, true, true));
}

TEST_CASE("an observer sees every iterate, and a spent budget is said") {
  const Scene scene = cantilever(8, {1e6, 0.3}, Strain::green);
  const auto rival = newton(scene, h);
  State state = scene.initial;
  int seen = 0;
  double last_seconds = 0, first_residual = 0;
  const Report report = rival->step(state, {.tolerance = 1e-12, .max_iterations = 2}, [&](const Iterate& it) {
    CHECK(it.iteration == seen++);
    CHECK(it.seconds >= last_seconds);
    last_seconds = it.seconds;
    if (seen == 1) first_residual = it.residual;
  });
  CHECK(seen == 3);
  CHECK(report.iterations == 2);
  CHECK(report.status == Status::not_converged);
  CHECK(report.reason == "iterations spent");
  CHECK(report.residual < first_residual);
  CHECK(report.seconds >= last_seconds);
}

TEST_CASE("a stiffness that never changes is factorised once") {
  const auto rival = newton(cantilever(8, {1e6, 0.3}, Strain::linear), h);
  State state = cantilever(8, {1e6, 0.3}, Strain::linear).initial;
  CHECK(rival->step(state).factorisations == 1);
  const Report second = rival->step(state);
  CHECK(second.factorisations == 0);
  CHECK(second.iterations == 1);
  CHECK(second.status == Status::ok);
}

TEST_CASE("a tolerance beyond rounding ends at rounding") {
  const Scene scene = cantilever(8, {1e7, 0.49}, Strain::green);
  const auto rival = newton(scene, h);
  State state = scene.initial;
  for (int i = 0; i < 3; ++i) {
    const Report report = rival->step(state, {.tolerance = 0});
    CHECK(report.status == Status::ok);
    CHECK(report.iterations < 20);
  }
}

TEST_CASE("a step that is not finite leaves the state") {
  const Scene scene = cantilever(8, {1e6, 0.3}, Strain::green);
  State state = scene.initial;
  state.v(0, 20) = infinity;
  const Report report = newton(scene, h)->step(state);
  CHECK(report.status == Status::diverged);
  CHECK(state.x == scene.initial.x);
  CHECK(state.time == 0);
}

TEST_CASE("what the rival cannot do is refused") {
  Scene scene = sheet(true, true, true);
  CHECK(refusal(scene).empty());
  CHECK(refusal(scene, 0) == "newton: h: got 0.000000; allowed: a finite number > 0, s");
  std::get<Distance>(scene.effects[3]).compliance[7] = 0;
  CHECK(refusal(scene) ==
        "newton: distance compliance[7]: got 0; allowed: a number > 0: no hard constraints");
  scene = sheet(true, true, true);
  std::get<Anchor>(scene.effects[2]).compliance[0] = 0;
  CHECK(refusal(scene).rfind("newton: anchor compliance[0]", 0) == 0);
  scene = sheet(true, true, true);
  std::get<Bending>(scene.effects[5]).compliance[1] = 0;
  CHECK(refusal(scene).rfind("newton: bending compliance[1]", 0) == 0);
  scene = sheet(true, true, true);
  std::get<TriangleStrain>(scene.effects[4]).material.young = infinity;
  CHECK(refusal(scene).rfind("newton: triangle_strain young: got inf", 0) == 0);
  scene = sheet(true, true, true);
  std::get<Distance>(scene.effects[3]).node[0] = {0, 99};
  CHECK(refusal(scene).find("a node index") != std::string::npos);
  scene = sheet(true, true, true);
  std::get<TriangleStrain>(scene.effects[4]).damping = Material{1, 0.3};
  CHECK(refusal(scene) == "newton: got an effect with damping; allowed: elastic effects");
  scene.effects.clear();
  for (double& mass : scene.mass) mass = infinity;
  CHECK(refusal(scene).rfind("newton: scene mass", 0) == 0);
}

TEST_CASE("the list of rivals") {
  REQUIRE(rivals::rivals().size() == 3);
  CHECK(rivals::rivals()[0].name == "newton");
  CHECK(rivals::rivals()[1].name == "vbd");
  CHECK(rivals::rivals()[2].name == "xpbd");
}
