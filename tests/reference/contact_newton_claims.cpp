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
  const auto j = judged_near(claim);
  // Friction would take half of g h = 5 % of its speed; rows miss a part of that for what their law projects.
  CHECK(j.claim_residual > 0.01);
  CHECK(j.claim_residual < infinity);
  CHECK(j.v(0, 1) < 0.96);
}

// Features of what is so deep do not count as touching (feature_search.h).
TEST_CASE("a claim that ends deeper in another cube is none though nothing touches there") {
  const double slow = 0.1;
  Cube cube(Vec3(0, 0, 0.7 * side), Vec3(0, 0, -slow), true);
  const StepClaim claim = cube.ends_with(Vec3(0, 0, -slow - judged_step_s * gravity));
  CHECK(judged_near(claim).claim_residual == infinity);
}
