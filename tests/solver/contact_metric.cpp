// Contacts that quasi_newton leaves dual in its metric.
#include "body_scenes.h"
#include "contact_runs.h"
#include "scenes.h"
#include "scenes/contacts.h"

using namespace pbd;
using namespace pbd::test;
using namespace pbdcheck;

namespace {

constexpr double thickness = 2e-3;  // m

/// A soft block stands on the ground; a box and a spinning ball come down on it askew.
Scene bodies_on_block(const ContactLaw& law, Strain strain, bool with_bodies) {
  BodyScene build(law);
  build.ground();
  if (with_bodies) {
    build.box(Vec3(0.12, 0.12, 0.06), 1,
              {.position = Vec3(-0.05, 0.01, 0.235), .velocity = Vec3(0.4, 0.2, -0.5)});
    build.ball(0.05, 0.5,
               {.position = Vec3(0.13, -0.02, 0.26), .velocity = Vec3(-0.3, 0, -1), .spin = Vec3(0, 9, 0)});
  }
  build.contact().thickness = thickness;
  Scene scene = build.finish();
  const TetMesh mesh = kuhn_grid({4, 2, 2}, Vec3(0.4, 0.2, 0.2), Vec3(-0.2, -0.1, thickness / 2));
  const int first = add_touching_solid(scene, mesh, 500, {5e4, 0.3}, strain);
  for (int node = first; node < scene.nodes(); ++node) scene.initial.v.col(node) = Vec3(0.1, 0, -0.2);
  return scene;
}

}  // namespace

TEST_CASE(
    "quasi_newton solves contact of solids, with bodies and alone, as proximal does, and auto by either") {
  const auto strain = GENERATE(Strain::green, Strain::corotational);
  const std::string friction = GENERATE("coulomb", "cone", "disc", "none");
  const bool with_bodies = GENERATE(true, false);
  const Scene scene = bodies_on_block({.friction = friction == "none" ? 0 : 0.4}, strain, with_bodies);
  Method method = contact_method("direct", friction == "none" ? "coulomb" : friction);
  method.tolerance = 1e-10;
  method.outer = "proximal";
  Workspace proximal(scene, method);
  method.outer = "quasi_newton";
  Workspace quasi_newton(scene, method);
  method.outer = "auto";
  Workspace automatic(scene, method);
  State state = scene.initial;
  constexpr double h = 0.005;
  std::size_t most_contacts = 0;
  for (int k = 0; k < 8; ++k) {
    State exact = state, by_default = state;
    const State before = state;
    REQUIRE(step(proximal, h, exact).status == Status::ok);
    const Report report = step(quasi_newton, h, state);
    INFO("step " << k << ": " << report.reason << ", residual " << report.residual());
    REQUIRE(report.status == Status::ok);
    REQUIRE(step(automatic, h, by_default).status == Status::ok);
    for (const State* end : {&state, &by_default})
      CHECK((end->x - exact.x).norm() <= 1e-8 * (exact.x - before.x).norm());
    most_contacts = std::max(most_contacts, quasi_newton.contacts().size());
  }
  CHECK(most_contacts >= (with_bodies ? 12u : 9u));
}

TEST_CASE("quasi_newton refuses contact beside rows that it cannot eliminate") {
  Scene scene = bodies_on_block({}, Strain::corotational, true);
  BodyDistance link;
  link.body.push_back({1, 2});
  link.point.push_back({Vec3::Zero(), Vec3::Zero()});
  link.rest_length.push_back(0.2);
  link.compliance.push_back(0);
  scene.effects.emplace_back(link);
  Method method;
  method.outer = "quasi_newton";
  CHECK_THROWS_WITH(Workspace(scene, method), Catch::Contains("contact beside joints or hard constraints"));
  method.outer = "auto";
  CHECK_NOTHROW(Workspace(scene, method));
}

TEST_CASE(
    "a soft block that slides by the convex law is solved in every step, and one that rests in no "
    "iteration") {
  Scene scene = bodies_on_block({.friction = 0.4}, Strain::corotational, false);
  Method method = contact_method("direct", "cone");
  method.tolerance = 1e-8;
  SECTION("slides") {
    for (int node = 1; node < scene.nodes(); ++node) scene.initial.v.col(node) = Vec3(1, 0.3, -0.4);
    run(scene, method, 0.01, 40);
  }
  SECTION("rests") {
    for (int node = 1; node < scene.nodes(); ++node) scene.initial.v.col(node).setZero();
    std::get<Gravity>(scene.effects[0]).acceleration.setZero();
    State state = scene.initial;
    const Report report = one_step(scene, method, 0.01, state);
    CHECK(report.status == Status::ok);
    CHECK(report.outer_iterations == 0);
    CHECK(state.x == scene.initial.x);
  }
}

TEST_CASE("what solves no local problem is not given one") {
  const Scene scene = bodies_on_block({.friction = 0.4}, Strain::corotational, true);
  Method method = contact_method("augmented_lagrangian");
  method.tolerance = 1e-8;
  run(scene, method, 0.005, 5);
  method.outer = "quasi_newton";
  CHECK_THROWS_WITH(Workspace(scene, method), Catch::Contains("augmented_lagrangian"));
}
