#include <catch2/catch.hpp>

#include "step/step.h"
#include "studies/robustness/generated_world.h"
#include "studies/robustness/same_scene.h"
#include "validate.h"

using namespace pbdcheck;

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

TEST_CASE("a scene that says the same ends its step alike: mirrored, or with its parts in another order") {
  int compared = 0;
  for (int i = 0; i < 30; ++i) {
    const World world = generated_world(i);
    const auto end_of = [&](const pbd::Scene& scene, pbd::State& state) {
      pbd::Workspace workspace(scene, world.method);
      state = scene.initial;
      return step(workspace, world.h, state);
    };
    const Isometry mirrored{pbd::Vec3(-1, 1, 1).asDiagonal(), pbd::Vec3(1, 2, 3)};
    Random random(17);
    const Order order = any_order(world.scene, random);
    pbd::State usual, mirror, other;
    const auto report = end_of(world.scene, usual);
    const auto by_mirror = end_of(moved(world.scene, mirrored), mirror);
    const auto by_order = end_of(reordered(world.scene, order), other);
    // A hard contact's Delassus matrix may be ill-conditioned; the tangents of the law box are the world's.
    const auto close = [&](const pbd::Points& a, const pbd::Points& b) {
      return (a - b).norm() <= 1e-4 * std::max(1.0, b.norm());
    };
    INFO("world " << i);
    if (report.status != pbd::Status::ok) continue;
    if (by_mirror.status == pbd::Status::ok && world.method.friction != "box") {
      ++compared;
      CHECK(close(moved(usual, mirrored).v, mirror.v));
      CHECK(close(moved(usual, mirrored).spin, mirror.spin));
    }
    // World 20 bounces by more than one way at 0.8 rad a step.
    if (by_order.status == pbd::Status::ok && i != 20) {
      CHECK(close(reordered(usual, order).v, other.v));
      CHECK(close(reordered(usual, order).spin, other.spin));
    }
  }
  CHECK(compared > 15);
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
