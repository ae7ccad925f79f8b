#include <catch2/catch.hpp>

#include "harness/step_checks.h"
#include "scenes/contacts.h"
#include "studies/robustness/same_scene.h"
#include "studies/robustness/same_step.h"
#include "validate.h"

using namespace pbdcheck;

namespace {

struct CheckedSteps {
  StepChecks checks;
  double fastest = 0;  // m/s
};

CheckedSteps checked_steps(const World& world, int steps) {
  CheckedSteps found;
  pbd::Workspace workspace(world.scene, world.method);
  pbd::State state = world.scene.initial;
  for (int k = 1; k <= steps; ++k) {
    const pbd::State begun = state;
    const pbd::Report report = step(workspace, world.h, state);
    found.checks.add(k, claim_of(world.scene, workspace, begun, state, world.h, report), report.status,
                     false);
    found.fastest = std::max(found.fastest, state.v.cwiseAbs().maxCoeff());
  }
  return found;
}

}  // namespace

TEST_CASE("every generated world is a valid scene with a valid method, the same each time") {
  for (int i = 0; i < 50; ++i) {
    const World once = generated_world(i), again = generated_world(i);
    CHECK_NOTHROW(pbd::validate(once.scene));
    CHECK_NOTHROW(pbd::Workspace(once.scene, once.method));
    CHECK(once.scene.initial.x == again.scene.initial.x);
    CHECK(once.scene.effects.size() == again.scene.effects.size());
    CHECK(once.method.integrator == again.method.integrator);
    CHECK(once.h == again.h);
  }
}

TEST_CASE("a scene that says the same ends its step alike, and no such step is refuted") {
  int alike = 0;
  for (int i = 0; i < 30; ++i) {
    const World world = generated_world(i);
    Random random(17);
    const FirstStep own = first_step(world.scene, world.method, world.h);
    CHECK(own.refuted.empty());
    for (const Variant& variant : variants_of(world, random)) {
      INFO("world " << i << ", " << variant.name);
      const Comparison found = compare(world, own, variant);
      CHECK(found.refuted.empty());
      if (found.turn < 0.5) CHECK(found.agreement != Agreement::other_solution);
      alike += found.agreement == Agreement::same;
    }
  }
  CHECK(alike > 30 * 4);  // of at most six each: else little has been seen
}

TEST_CASE("steps of explicit forces that blow up are not refuted: their contacts act where the step begins") {
  for (const auto& [i, steps] : {std::pair{5507, 4}, {19872, 5}, {19968, 3}}) {
    const CheckedSteps found = checked_steps(generated_world(i), steps);
    INFO("world " << i);
    CHECK(found.checks.refuted_steps() == 0);
    CHECK(found.checks.judged() >= 2);  // so far beyond stability some miss their tolerance
    CHECK(found.fastest > 1e8);
  }
}

TEST_CASE("a world that generalised_alpha blew up by what its impacts left goes on at its own speeds") {
  const CheckedSteps found = checked_steps(generated_world(19425), 20);
  CHECK(found.checks.refuted_steps() == 0);
  CHECK(found.checks.judged() >= 15);
  CHECK(found.fastest < 1e3);  // m/s; blown up, by 1e8 after five steps
}

TEST_CASE("impulses that redundant joints raise against each other excuse no other body") {
  const CheckedSteps found = checked_steps(generated_world(12114), 8);
  CHECK(found.checks.refuted_steps() == 0);
  CHECK(found.checks.judged() > 0);
}

TEST_CASE("what is held by a damped joint is not refuted: the joint's force is told in a body's axes") {
  for (const int i : {881, 5979, 9573, 10602}) {
    INFO("world " << i);
    const World world = generated_world(i);
    const FirstStep own = first_step(world.scene, world.method, world.h);
    CHECK(own.report.status == pbd::Status::ok);
    CHECK(own.refuted.empty());
  }
}

TEST_CASE("a scene that says something else ends its step otherwise, at any tolerance") {
  pbdcheck::BodyScene build({.friction = 0.5});
  build.ground(0.3);
  build.box({0.2, 0.2, 0.1}, 4, {.position = {0, 0, 0.3}, .velocity = {1, 0, 0}});
  const World world{build.finish(), {}, 0.01};
  const FirstStep own = first_step(world.scene, world.method, world.h);
  Variant heavier{"less gravity", world.scene, world.method, [](const pbd::State& state) { return state; }};
  for (auto& effect : heavier.scene.effects)
    if (auto* gravity = std::get_if<pbd::Gravity>(&effect)) gravity->acceleration *= 0.99;
  const Comparison found = compare(world, own, heavier);
  CHECK(found.agreement == Agreement::other_solution);
  CHECK(found.apart == Approx(0.01 / 0.99 / 2).epsilon(1e-6));  // of |v - v_l| + |v_free - v_l|, both h g
}

TEST_CASE("mirrored twice a scene is what it was") {
  const pbd::Scene scene = generated_world(3).scene;
  const Isometry mirrored{pbd::Vec3(-1, 1, 1).asDiagonal(), pbd::Vec3::Zero()};
  const pbd::State twice = moved(moved(scene.initial, mirrored), mirrored);
  CHECK(twice.x == scene.initial.x);
  CHECK(twice.spin == scene.initial.spin);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    CHECK(twice.orientation[b].angularDistance(scene.initial.orientation[b]) < 1e-7);  // acos of 1 - rounding
}
