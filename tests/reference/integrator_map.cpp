// Steps of BDF2 with contact, by hand: what the memory makes of two claimed steps, and what the judge of it.
#include "integrator_map.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "judged_contact.h"

using namespace pbd;
using namespace pbd::reference;
using namespace pbd::test;
using pbdcheck::BodyScene;

namespace {

/// A body or node (column 1) that is at `x` with velocity `v` a step later.
State later(const State& from, const Vec3& x, const Vec3& v) {
  State state = from;
  state.time += judged_step_s;
  state.x.col(1) = x;
  state.v.col(1) = v;
  return state;
}

StepClaim claim_by_bdf2(const Scene& scene, const State& start, const State& end) {
  StepClaim claim{.scene = scene, .start = start, .end = end, .h = judged_step_s, .integrator = "bdf2"};
  claim.forces.resize(scene.effects.size());
  return claim;
}

Method by(const std::string& integrator, double rho = 0) {
  Method method;
  method.integrator = integrator;
  method.rho = rho;
  return method;
}

Scene box_on_ground(double friction, const Vec3& position, const Vec3& velocity) {
  BodyScene build({.friction = friction}, gravity);
  build.ground();
  build.box(Vec3(0.4, 0.4, 0.1), 4, {.position = position, .velocity = velocity});
  return build.finish();
}

}  // namespace

TEST_CASE("a fall by BDF2 is a step of implicit Euler and then by both last places") {
  const Vec3 from(0, 0, 5), down = -gravity * Vec3::UnitZ();
  const Scene scene = box_on_ground(0.5, from, Vec3(1, 0, 0));
  const double h = judged_step_s;
  const Vec3 v0(1, 0, 0), v1 = v0 + h * down, x1 = from + h * v1;
  const State first = later(scene.initial, x1, v1);
  IntegratorMemory memory(by("bdf2"));
  const StepClaim start = claim_by_bdf2(scene, scene.initial, first);
  CHECK_FALSE(memory.map_of(start).has_value());
  memory.follow(start);
  const Vec3 v2 = v1 + (v1 - v0) / 3 + 2.0 / 3 * h * down, x2 = x1 + (x1 - from) / 3 + 2.0 / 3 * h * v2;
  const State second = later(first, x2, v2);
  const auto map = memory.map_of(claim_by_bdf2(scene, first, second));
  REQUIRE(map.has_value());
  const auto j = judged(scene, first, Friction::coulomb, cone_interior_point, {.map = &*map});
  CHECK((j.x.col(1) - x2).norm() <= by_hand * h);
  CHECK((j.v.col(1) - v2).norm() <= by_hand);
  // What ends where implicit Euler leads to is a step of that; so is one from elsewhere.
  const Vec3 v_euler = v1 + h * down;
  CHECK_FALSE(
      memory.map_of(claim_by_bdf2(scene, first, later(first, x1 + h * v_euler, v_euler))).has_value());
  const State moved = later(first, x1 + Vec3(1e-3, 0, 0), v1);
  CHECK_FALSE(memory.map_of(claim_by_bdf2(scene, moved, second)).has_value());
}

TEST_CASE("a box that slides by BDF2 loses the speed of friction in each step and no more") {
  const double mu = 0.3, h = judged_step_s, lost = mu * gravity * h;
  const Vec3 from(0, 0, 0.05);
  const Scene scene = box_on_ground(mu, from, Vec3(1, 0, 0));
  const Vec3 v1(1 - lost, 0, 0), x1 = from + h * v1;
  const State first = later(scene.initial, x1, v1);
  IntegratorMemory memory(by("bdf2"));
  memory.follow(claim_by_bdf2(scene, scene.initial, first));
  // Contacts' impulses act over h and are not carried on: base_x = v1, base_z = -g h/3, and gravity adds
  // -2/3 g h to it, so that the ground gives g h as ever.
  const Vec3 v2(1 - 2 * lost, 0, 0), x2 = x1 + (x1 - from) / 3 + 2.0 / 3 * h * v2;
  const State second = later(first, x2, v2);
  const auto map = memory.map_of(claim_by_bdf2(scene, first, second));
  REQUIRE(map.has_value());
  CHECK(std::abs(map->base[0] - v1.x()) <= by_hand);
  CHECK(std::abs(map->base[2] + gravity * h / 3) <= by_hand);
  const auto j = judged(scene, first, Friction::coulomb, cone_interior_point, {.map = &*map});
  CHECK((j.v.col(1) - v2).norm() <= by_hand);
  CHECK((j.x.col(1) - x2).norm() <= by_hand * h);
}

TEST_CASE("a box comes down by BDF2 where its gap closes") {
  const double h = judged_step_s;
  const Vec3 from(0, 0, 0.09), v0(0, 0, -2);
  const Scene scene = box_on_ground(0, from, v0);
  const Vec3 v1 = v0 - h * gravity * Vec3::UnitZ(), x1 = from + h * v1;
  const State first = later(scene.initial, x1, v1);
  IntegratorMemory memory(by("bdf2"));
  memory.follow(claim_by_bdf2(scene, scene.initial, first));
  // x2 = x1 + (x1 - x0)/3 + 2/3 h v2 is to be half the box's height.
  const double down = (0.05 - x1.z() - (x1.z() - from.z()) / 3) / (2.0 / 3 * h);
  const State second = later(first, Vec3(0, 0, 0.05), Vec3(0, 0, down));
  const auto map = memory.map_of(claim_by_bdf2(scene, first, second));
  REQUIRE(map.has_value());
  const auto j = judged(scene, first, Friction::coulomb, cone_interior_point, {.map = &*map});
  CHECK(std::abs(j.x(2, 1) - 0.05) <= by_hand * h);
  CHECK(std::abs(j.v(2, 1) - down) <= by_hand);
}

TEST_CASE("a box that slides by generalised alpha follows its parabola whatever rho is") {
  const double mu = 0.3, h = judged_step_s, slowing = mu * gravity;
  const Vec3 from(0, 0, 0.05), along = Vec3::UnitX();
  const Scene scene = box_on_ground(mu, from, along);
  for (const double rho : {0.0, 0.5, 0.8}) {
    IntegratorMemory memory(by("generalised_alpha", rho));
    const auto claim = [&](const State& start, const State& end) {
      StepClaim made = claim_by_bdf2(scene, start, end);
      made.integrator = "generalised_alpha";
      return made;
    };
    // A start is implicit Euler's. From there on contacts brought -mu g and g, what is carried on is gravity:
    // x = x_l + h v_l - h^2/2 mu g, as of a constant force.
    Vec3 v = (1 - slowing * h) * along, x = from + h * v;
    State now = later(scene.initial, x, v);
    memory.follow(claim(scene.initial, now));
    for (int k = 0; k < 2; ++k) {
      x += h * v - h * h / 2 * slowing * along;
      v -= h * slowing * along;
      const State next = later(now, x, v);
      const auto map = memory.map_of(claim(now, next));
      REQUIRE(map.has_value());
      const auto j = judged(scene, now, Friction::coulomb, cone_interior_point, {.map = &*map});
      CHECK((j.v.col(1) - v).norm() <= by_hand);
      CHECK((j.x.col(1) - x).norm() <= by_hand * h);
      memory.follow(claim(now, next));
      now = next;
    }
  }
}

TEST_CASE("integrators that the judge does not state are refused by name") {
  CHECK_THROWS_WITH(IntegratorMemory(by("symplectic_euler")), Catch::Contains("symplectic_euler"));
}
