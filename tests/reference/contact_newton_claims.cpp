// What a claim leaves of the equations of the judge that starts from it.
#include <catch2/catch.hpp>

#include "judged_contact.h"
#include "step_claim.h"

using namespace pbd;
using namespace pbd::reference;
using namespace pbd::test;
using pbdcheck::BodyScene;

namespace {

constexpr double side = 0.2, mass = 4;

/// A cube above the ground, or above one that is fixed.
struct Cube {
  Scene scene;
  State end{};  // of a claim

  Cube(const Vec3& at, const Vec3& velocity, bool on_cube = false) {
    BodyScene bodies(ContactLaw{.friction = 0.5}, gravity);
    if (on_cube)
      bodies.fixed(Box{Vec3::Constant(side)}, {.position = Vec3::Zero()});
    else
      bodies.ground();
    bodies.box(Vec3::Constant(side), mass, {.position = at, .velocity = velocity});
    scene = bodies.finish();
  }

  StepClaim ends_with(const Vec3& velocity) {
    end = scene.initial;
    end.time = judged_step_s;
    end.v.col(1) = velocity;
    end.x.col(1) += judged_step_s * velocity;
    return {.scene = scene, .start = scene.initial, .end = end, .h = judged_step_s};
  }
};

void push(StepClaim& claim, const Vec3& corner, double newtons) {
  ClaimedContact contact;
  contact.collider = {1, 0};
  contact.point = corner;
  contact.normal = Vec3::UnitZ();
  contact.force = newtons * Vec3::UnitZ();
  claim.contacts.push_back(contact);
}

ContactJudgement judged_near(const StepClaim& claim) {
  return contact_newton(claim.scene, claim.start, claim.h, Friction::coulomb, cone_interior_point, {&claim});
}

}  // namespace

TEST_CASE("a claim that is one of many solutions leaves nothing of the judge's equations") {
  Cube cube(Vec3(0, 0, side / 2), Vec3::Zero());
  StepClaim claim = cube.ends_with(Vec3::Zero());
  const double half = mass * gravity / 2;  // of its weight, on two corners across: on four it stands, too
  push(claim, Vec3(side / 2, side / 2, 0), half);
  push(claim, Vec3(-side / 2, -side / 2, 0), half);
  const auto j = judged_near(claim);
  CHECK(j.claim_residual <= 1e-14);
  CHECK(std::isnan(judged(cube.scene).claim_residual));
}

TEST_CASE("a claim whose forces leave a millionth of a weight leaves it of the judge's equations") {
  Cube cube(Vec3(0, 0, side / 2), Vec3::Zero());
  StepClaim claim = cube.ends_with(Vec3::Zero());
  const double half = (1 + 1e-6) * mass * gravity / 2;
  push(claim, Vec3(side / 2, side / 2, 0), half);
  push(claim, Vec3(-side / 2, -side / 2, 0), half);
  const auto j = judged_near(claim);
  CHECK(j.outcome == Outcome::ok);
  // Of all forces that act: the weight and what carries it.
  CHECK(std::abs(j.claim_residual - 1e-6 / 2) <= 1e-11);
}

TEST_CASE("a claim that slides without friction leaves it of the contacts' law") {
  const Vec3 velocity(1, 0, 0);
  Cube cube(Vec3(0, 0, side / 2), velocity);
  StepClaim claim = cube.ends_with(velocity);
  const double half = mass * gravity / 2;
  push(claim, Vec3(side / 2, side / 2, 0), half);
  push(claim, Vec3(-side / 2, -side / 2, 0), half);
  // Of the speed: r - P(r - m (u_n + mu |u_t|, u_t)), where P takes r_n (1, -mu)/(1 + mu^2) for far slip.
  const double mu = 0.5, missed = judged_step_s * gravity / 2 * mu / std::sqrt(1 + mu * mu);
  CHECK(std::abs(judged_near(claim).claim_residual - missed) <= 1e-12);
}

TEST_CASE("a claim of what rests is measured by how far it would fall") {
  constexpr double share = 1e-10;
  Cube cube(Vec3(0, 0, side / 2), Vec3::Zero());
  StepClaim claim = cube.ends_with(Vec3(0, 0, -share * judged_step_s * gravity));
  const double half = mass * gravity / 2;
  push(claim, Vec3(side / 2, side / 2, 0), half);
  push(claim, Vec3(-side / 2, -side / 2, 0), half);
  CHECK(std::abs(judged_near(claim).claim_residual - share) <= 1e-3 * share);
}

TEST_CASE("a claim that forgets a spring leaves what that misses") {
  const double compliance = 1e-4, stretched = 0.1, weight = mass + judged_step_s * judged_step_s / compliance;
  Scene scene;
  add_node(scene, Vec3(stretched, 0, 0), mass);
  scene.effects.emplace_back(Anchor{.node = {0}, .target = {Vec3::Zero()}, .compliance = {compliance}});
  const auto left = [&](double velocity, double force) {
    State end = scene.initial;
    end.v(0, 0) = velocity;
    StepClaim claim{.scene = scene, .start = scene.initial, .end = end, .h = judged_step_s};
    claim.forces = {{force, 0, 0}};
    return judged_near(claim).claim_residual;
  };
  const double velocity = -judged_step_s * stretched / compliance / weight;
  CHECK(left(velocity, mass * velocity / judged_step_s) <= 1e-12);
  CHECK(left(0, 0) > 1);
}

TEST_CASE("a claim's forces are compared with those on the same body") {
  Scene scene;
  add_node(scene, Vec3::Zero(), 1e6);
  add_node(scene, Vec3::UnitX(), 1e-3);
  scene.effects.emplace_back(Gravity{.acceleration = Vec3(0, 0, -gravity)});
  State end = scene.initial;
  end.v.row(2).setConstant(-judged_step_s * gravity);
  StepClaim claim{.scene = scene, .start = scene.initial, .end = end, .h = judged_step_s};
  CHECK(judged_near(claim).claim_residual <= 1e-12);
  end.v(2, 1) *= 0.9;  // 5e-11 of the forces on the heavy one
  CHECK(judged_near(claim).claim_residual > 1e-6);
  end.v(2, 1) = std::nan("");
  CHECK(std::isnan(judged_near(claim).claim_residual));
}

TEST_CASE("a claim that stops what is pushed into a wall leaves its rebound") {
  constexpr double radius = 0.1, ball = 1, newtons = ball / judged_step_s;
  for (const double restitution : {0.0, 1.0}) {
    BodyScene bodies({.friction = 0, .restitution = restitution}, 0);
    bodies.materials(2, {.friction = 0, .restitution = restitution});
    bodies.law(1, 1, {.friction = 0});
    bodies.ground();
    // The upper one meets the lower one, which would not come to the ground by itself.
    bodies.ball(radius, ball, {.position = Vec3(0, 0, radius + 0.02), .velocity = Vec3(0, 0, -1)}, 1);
    bodies.ball(radius, ball, {.position = Vec3(0, 0, 3 * radius + 0.03), .velocity = Vec3(0, 0, -5)}, 1);
    const Scene scene = bodies.finish();
    State end = scene.initial;
    end.v(2, 1) = -2, end.v(2, 2) = -3;
    end.x(2, 1) -= 0.02, end.x(2, 2) -= 0.03;
    StepClaim claim{.scene = scene, .start = scene.initial, .end = end, .h = judged_step_s};
    push(claim, Vec3::Zero(), newtons);
    push(claim, Vec3(0, 0, 2 * radius), 2 * newtons);
    claim.contacts.back().collider = {2, 1};
    CHECK((judged_near(claim).claim_residual <= 1e-12) == (restitution == 0));
  }
}

TEST_CASE("a claim by a map that extends its step is taken back to where it was solved") {
  Cube cube(Vec3(0, 0, 10), Vec3(0, 0, -1));
  IntegratorMap midpoint{.d = judged_step_s / 2,
                         .s = judged_step_s / 2,
                         .shift = Vector::Zero(6),
                         .base = Vector::Zero(6),
                         .extension = 2};
  midpoint.base[2] = -1;
  for (const double share : {1.0, 0.5}) {
    const StepClaim claim = cube.ends_with(Vec3(0, 0, -1 - share * judged_step_s * gravity));
    const ContactStart start{.near = &claim, .map = &midpoint};
    const auto j =
        contact_newton(claim.scene, claim.start, claim.h, Friction::coulomb, cone_interior_point, start);
    CHECK((j.claim_residual <= 1e-12) == (share == 1));
  }
}

// Features of what is so deep do not count as touching (feature_search.h).
TEST_CASE("a claim that ends deeper in another cube is none though nothing touches there") {
  const double slow = 0.1;
  Cube cube(Vec3(0, 0, 0.7 * side), Vec3(0, 0, -slow), true);
  const StepClaim claim = cube.ends_with(Vec3(0, 0, -slow - judged_step_s * gravity));
  CHECK(judged_near(claim).claim_residual == infinity);
}
