#include "contact_contraction.h"

#include <catch2/catch.hpp>

#include "error.h"

using namespace pbd;
using namespace pbd::reference;

namespace {

constexpr double g = 9.81, h = 1.0 / 30, below = 0.3, radius = 0.1, mass = 2;

/// A ball on top of a fixed one, both at rest.
Scene balanced_ball(double friction) {
  Scene scene;
  add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
  add_body(scene, Vec3(0, 0, below + radius), mass, Vec3::Constant(0.4 * mass * radius * radius));
  Contact contact;
  contact.collider = {{Sphere{below}, 0}, {Sphere{radius}, 1}};
  contact.law = {{.friction = friction}};
  scene.effects = {Gravity{Vec3(0, 0, -g)}, contact};
  return scene;
}

/// As a solver might tell it, not quite right.
ContactContraction judged(const Scene& scene, const Vec3& force, Friction law = Friction::coulomb) {
  const State& start = scene.initial;
  StepClaim claim{.scene = scene, .start = start, .end = start, .h = h, .friction = law};
  claim.contacts = {
      {.collider = {1, 0}, .point = Vec3(0, 0, below), .normal = Vec3::UnitZ(), .force = force}};
  return plain_contraction_of_contacts(claim);
}

}  // namespace

// A velocity e across moves the ball by h e and tilts the weight that holds it by h e/(R + r). What sticks
// rolls: its inertia is 7/5 m.
TEST_CASE("a ball that balances on a ball contracts by its weight over what rolls") {
  for (const Friction law : {Friction::coulomb, Friction::cone}) {
    const ContactContraction found = judged(balanced_ball(0.5), Vec3(0, 0, 1.1 * mass * g), law);
    REQUIRE(found.solved.outcome == Outcome::ok);
    CHECK(found.sticking == 1);
    CHECK(found.sliding == 0);
    CHECK(found.margin == Approx(1));
    CHECK(found.solved.v.norm() < 1e-12);
    CHECK(found.rate.largest == Approx(h * h * g / (below + radius) / 1.4).epsilon(1e-6));
    CHECK(std::abs(found.rate.smallest) < 1e-6);
  }
}

// It spins in its place, as friction does not hold it.
TEST_CASE("without friction a ball that slides contracts by its weight over its mass") {
  Scene scene = balanced_ball(0);
  scene.initial.spin.col(1) = Vec3(0, 5, 0);
  const ContactContraction found = judged(scene, Vec3(0, 0, mass * g));
  REQUIRE(found.solved.outcome == Outcome::ok);
  CHECK(found.sliding == 1);
  CHECK(found.rate.largest == Approx(h * h * g / (below + radius)).epsilon(1e-6));
}

TEST_CASE("the judge of contraction in contact refuses what it has no formula for") {
  Scene scene = balanced_ball(0.5);
  CHECK_THROWS_AS(judged(scene, Vec3(0, 0, 1), Friction::box), SetupError);
  std::get<Contact>(scene.effects[1]).collider[1].shape = Capsule{radius, radius};
  CHECK_THROWS_AS(judged(scene, Vec3(0, 0, 1)), SetupError);
  scene = balanced_ball(0.5);
  std::get<Contact>(scene.effects[1]).law[0].restitution = 0.5;
  CHECK_THROWS_AS(judged(scene, Vec3(0, 0, 1)), SetupError);
  scene.effects = {Gyroscopic{}, balanced_ball(0.5).effects[1]};
  CHECK_THROWS_AS(judged(scene, Vec3(0, 0, 1)), SetupError);
}
