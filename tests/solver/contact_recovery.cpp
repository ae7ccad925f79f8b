// What overlaps parts by a recovery speed at most; what began apart is let into nothing for it.
#include <catch2/catch.hpp>

#include "body_scenes.h"
#include "contact_runs.h"
#include "pressed_surfaces.h"
#include "scenes/contacts.h"
#include "step/step.h"

using namespace pbd;

TEST_CASE("a ball that begins beside a cube ends outside it, however slowly overlaps recover") {
  constexpr double radius = 0.1, side = 0.4, h = 0.01;  // m, m, s
  const double recovery = GENERATE(0.1, 1.0, infinity);
  pbdcheck::BodyScene build({.friction = 0.5}, 0);
  build.fixed(Box{Vec3::Constant(side)}, {});
  build.ball(radius, 1, {.position = {-0.31, 0.22, 0}, .velocity = {20, 0, 0}});
  build.contact().recovery = recovery;
  const Scene scene = build.finish();
  Workspace workspace(scene, Method{});
  State state = scene.initial;
  for (int k = 0; k < 4; ++k) {
    REQUIRE(step(workspace, h, state).status == Status::ok);
    const Vec3 beside = (state.x.col(1).cwiseAbs() - Vec3::Constant(side / 2)).cwiseMax(0);
    INFO("recovery " << recovery << ", step " << k);
    CHECK(beside.norm() >= radius * (1 - 1e-4));
  }
}

// 7.9 cm in each other across two edges, and by less across faces' sides, which they leave as they part. One
// contact that parts two bodies of 1 kg at r brings at most r^2/4 J kg: turning, they weigh less there.
TEST_CASE("two boxes that begin in each other edge to edge part by the recovery speed, whatever the step") {
  const double h = GENERATE(0.01, 0.005, 0.002, 0.001), recovery = GENERATE(0.1, 1.0);
  const double friction = GENERATE(0.0, 0.5);
  const auto turned = [](const Vec3& by) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(by.norm(), by.normalized()));
  };
  pbdcheck::BodyScene build({.friction = friction}, 0);
  build.box({0.2487, 0.2801, 0.2311}, 1,
            {.position = {0, 0.0003, 0.0352}, .orientation = turned({0.9993, -0.5292, 0.1353})});
  build.box({0.2446, 0.1695, 0.1675}, 1,
            {.position = {0.2504, 0, -0.0568}, .orientation = turned({-0.0198, 0.4677, -2.478})});
  build.contact().recovery = recovery;
  const Scene scene = build.finish();
  Workspace workspace(scene, Method{});
  State state = scene.initial;
  INFO("h " << h << ", recovery " << recovery << ", friction " << friction);
  REQUIRE(step(workspace, h, state).status == Status::ok);
  const double energy = test::kinetic_energy(scene, state);
  CHECK(energy > 0);
  CHECK(energy <= recovery * recovery / 4);
}

TEST_CASE("surfaces in each other part by a tenth of their thickness in a step") {
  using namespace pbd::test;
  PressedSurfaces pressed(GENERATE(Pressing::node, Pressing::edge), {.friction = 0.3});
  pressed.sink();
  const State end = run(pressed.scene, contact_method("direct"), PressedSurfaces::h, 1);
  for (const int node : pressed.nodes)
    CHECK((Vec3(end.v.col(node)) - pressed.after_sinking()).norm() <= 1e-9);
}

TEST_CASE("a sphere in a surface parts within the step, be it of radius 0") {
  using namespace pbd::test;
  const double radius = GENERATE(0.0, 0.05), deep = PressedSurfaces::thickness / 5;
  PressedSurfaces pressed(Pressing::sphere, {.friction = 0.3});
  std::get<Contact>(pressed.scene.effects[1]).radius = {radius};
  pressed.scene.initial.x(2, pressed.nodes[0]) = radius + PressedSurfaces::thickness / 2 - deep;
  const State end = run(pressed.scene, contact_method("direct"), PressedSurfaces::h, 1);
  const double up = deep / PressedSurfaces::h;
  const Vec3 expected(0, PressedSurfaces::speed - 0.3 * (up + pbdcheck::gravity * PressedSurfaces::h), up);
  CHECK((Vec3(end.v.col(pressed.nodes[0])) - expected).norm() <= 1e-9);
}
