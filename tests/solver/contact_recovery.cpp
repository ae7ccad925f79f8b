// What overlaps parts by a recovery speed at most; what began apart is let into nothing for it.
#include <catch2/catch.hpp>

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
