// Steps that the judge of contact solves, of surfaces that move along themselves and nodes that touch each
// other, by hand.
#include <catch2/catch.hpp>
#include <cmath>

#include "judged_contact.h"

using namespace pbd;
using namespace pbd::reference;
using namespace pbd::test;

TEST_CASE("a ball on ground that moves along itself is dragged, and turned, by friction") {
  const double mu = 0.05;
  pbdcheck::BodyScene build({.friction = mu}, gravity);
  build.ground();
  build.contact().collider[0].surface_velocity = {0, 2, 7};
  build.ball(0.1, 1, {.position = {0, 0, 0.1}});
  const Scene scene = build.finish();
  for (const auto law : {Friction::coulomb, Friction::cone}) {
    const auto j = judged(scene, law);
    // The convex law opens the gap by mu times the slip, 2 - 7/2 mu p, for an impulse of p.
    const double p = law == Friction::coulomb ? gravity * judged_step_s
                                              : (gravity * judged_step_s + 2 * mu) / (1 + 3.5 * mu * mu);
    CHECK(std::abs(j.v(1, 1) - mu * p) <= by_hand);
    CHECK(std::abs(j.spin(0, 1) - mu * p / 0.04) <= by_hand / 0.1);
  }
}

// m_a v_a + m_b v_b = 1 kg m/s, and the gap of 2 mm closes.
TEST_CASE("nodes that touch each other share their momentum, but not those of one link") {
  Scene scene;
  add_node(scene, Vec3::Zero(), 1, Vec3::UnitX());
  add_node(scene, Vec3(0.302, 0, 0), 3);
  Contact contact{.collider = {}};
  contact.node = {0, 1};
  contact.radius = {0.1, 0.2};
  contact.node_material = {0, 0};
  contact.nodes_touch = true;
  scene.effects = {contact};
  const auto met = judged(scene);
  CHECK(std::abs(met.v(0, 0) - 0.4) <= by_hand);
  CHECK(std::abs(met.v(0, 1) - 0.2) <= by_hand);
  scene.effects = {Distance{.node = {{0, 1}}, .rest_length = {0.302}, .compliance = {1e9}}, contact};
  CHECK(std::abs(judged(scene).v(0, 0) - 1) <= by_hand);
}
