// What limits stop, and what starts at velocities that constraints do not allow, under every integrator:
// nothing of the jump goes on.
#include <algorithm>
#include <catch2/catch.hpp>

#include "body_scenes.h"
#include "step/integrators.h"
#include "step/step.h"

using namespace pbd;
using namespace pbd::test;

namespace {

constexpr double h = 0.01;  // s

/// A body that leaves the world at `speed` (m/s) on a rope that tightens after `slack` m.
Scene roped_body(double speed, double slack, double compliance) {
  Scene scene = linked_body(1, 1 + slack, compliance, {{-infinity, 0}});
  scene.initial.v(0, 1) = speed;
  return scene;
}

Workspace workspace_of(const Scene& scene, const Integrator& integrator) {
  Method method;
  method.integrator = integrator.name;
  return {scene, method};
}

}  // namespace

TEST_CASE("a rope that gives no way stops what it catches, wherever in a step it tightens") {
  const auto part = GENERATE(0.0, 0.1, 0.5, 0.9);  // of the step in which it does
  for (const Integrator& integrator : integrators()) {
    const Scene scene = roped_body(1, (10 + part) * h, 0);
    Workspace workspace = workspace_of(scene, integrator);
    State state = scene.initial;
    for (int k = 0; k < 40; ++k) {
      INFO(integrator.name << ", step " << k);
      REQUIRE(step(workspace, h, state).status == Status::ok);
      CHECK(state.x(0, 1) <= 1 + (10 + part) * h + 1e-9);
      CHECK(state.v(0, 1) <= 1 + 1e-9);
      CHECK(state.v(0, 1) >= -1e-8);
    }
    INFO(integrator.name);
    CHECK(std::abs(state.v(0, 1)) <= 1e-8);
  }
}

TEST_CASE("a rope that gives way sends nothing back quicker than it came, however short its time is") {
  const auto compliance = GENERATE(1e-6, 1e-4, 1e-3);  // m/N: a quarter of an oscillation in 0.16 to 5 steps
  for (const Integrator& integrator : integrators()) {
    if (integrator.explicit_forces) continue;  // unstable beyond h = 2 sqrt(m A)
    const Scene scene = roped_body(1, 0.105, compliance);
    Workspace workspace = workspace_of(scene, integrator);
    State state = scene.initial;
    for (int k = 0; k < 60; ++k) {
      INFO(integrator.name << ", compliance " << compliance << ", step " << k);
      REQUIRE(step(workspace, h, state).status == Status::ok);
      const double stretch = std::max(0.0, state.x(0, 1) - 1.105);
      CHECK(state.v(0, 1) * state.v(0, 1) + stretch * stretch / compliance <= 1 + 1e-6);
    }
  }
}

TEST_CASE("a place or a velocity that a hard constraint does not allow is gone after two steps") {
  const auto [stretch, speed] = GENERATE(std::pair{0.0, 1.0}, std::pair{0.01, 0.0}, std::pair{0.01, 1.0});
  for (const Integrator& integrator : integrators()) {
    if (integrator.name == "midpoint") continue;  // unstable with hard constraints
    Scene scene = linked_body(1 + stretch, 1, 0, {});
    scene.initial.v(0, 1) = speed;
    Workspace workspace = workspace_of(scene, integrator);
    State state = scene.initial;
    for (int k = 0; k < 20; ++k) {
      INFO(integrator.name << ", step " << k);
      REQUIRE(step(workspace, h, state).status == Status::ok);
      if (k > 0) CHECK(state.v.cwiseAbs().maxCoeff() <= 1e-8);
    }
  }
}

TEST_CASE("what a workspace is told to begin anew carries on nothing") {
  // A place that jumps is two jumps of velocity: there, and to rest.
  for (const Integrator& integrator : integrators()) {
    if (integrator.name == "midpoint") continue;
    const Scene scene = linked_body(1, 1, 0, {});
    auto link = std::get<BodyDistance>(scene.effects[0]);
    Workspace workspace = workspace_of(scene, integrator);
    State state = scene.initial;
    for (int k = 0; k < 20; ++k) {
      if (k == 10) {
        link.rest_length = {1.01};
        workspace.change(0, link);
      }
      if (k == 10 || k == 11) workspace.begin_anew();
      INFO(integrator.name << ", step " << k);
      REQUIRE(step(workspace, h, state).status == Status::ok);
      if (k != 10) CHECK(std::abs(state.v(0, 1)) <= 1e-8);
    }
  }
}

TEST_CASE("bodies that are joined and drift without forces solve every step, but for rounding") {
  for (const Integrator& integrator : integrators())
    for (const double place : {-1.0, 0.0, 0.3, 7.0}) {
      Scene scene;
      const int a = add_body(scene, Vec3(place, 0, 0), 1, Vec3::Constant(0.004)),
                b = add_body(scene, Vec3(place - 0.5, 0, 0), 1, Vec3::Constant(0.004));
      PointJoint ball;
      join(ball, a, b, Vec3(-0.25, 0, 0), Vec3(0.25, 0, 0));
      scene.effects = {ball};
      scene.initial.v.row(0).setOnes();
      Workspace workspace = workspace_of(scene, integrator);
      State state = scene.initial;
      int missed = 0;
      for (int k = 0; k < 400; ++k) missed += step(workspace, h, state).status != Status::ok;
      INFO(integrator.name << " from " << place);
      CHECK(missed == 0);
    }
}

TEST_CASE("a taut rope gives what whirls on it no energy") {
  constexpr double speed = 3;  // m/s, round 1 m: 0.03 rad a step
  for (const Integrator& integrator : integrators()) {
    if (integrator.name == "midpoint") continue;  // unstable with hard constraints
    Scene scene = linked_body(1, 1, 0, {{-infinity, 0}});
    scene.initial.v(1, 1) = speed;
    Workspace workspace = workspace_of(scene, integrator);
    State state = scene.initial;
    double last = speed;
    for (int k = 0; k < 300; ++k) {
      INFO(integrator.name << ", step " << k);
      REQUIRE(step(workspace, h, state).status == Status::ok);
      const double now = state.v.col(1).norm(), turn = h * speed;
      CHECK(now <= last * (1 + turn * turn));  // a chord's speed is off by this order
      CHECK(now <= speed * (1 + turn * turn));
      CHECK(state.x.col(1).norm() <= 1 + 1e-8);
      last = now;
    }
  }
}

TEST_CASE("what a limit has stopped does not keep an integrator from its order elsewhere") {
  // Beside a cart that a limit stops a body swings on a spring: w = 10/s, 0.1 m.
  const auto end_of = [](const Integrator& integrator, double limit) {
    Scene scene;
    const int world = add_world(scene), cart = add_body(scene, Vec3(0, 5, 0), 1, Vec3::Ones()),
              swing = add_body(scene, Vec3(1.1, 0, 0), 1, Vec3::Ones());
    scene.initial.v(0, cart) = 1;
    scene.effects.emplace_back(SlideJoint{.body = {{world, cart}},
                                          .point = {{Vec3(0, 5, 0), Vec3::Zero()}},
                                          .axis = {Vec3::UnitX()},
                                          .rest_position = {limit},
                                          .rate = {0},
                                          .compliance = {0},
                                          .bounds = {{-infinity, 0}}});
    scene.effects.emplace_back(BodyDistance{.body = {{world, swing}},
                                            .point = {{Vec3::Zero(), Vec3::Zero()}},
                                            .rest_length = {1},
                                            .compliance = {0.01}});
    Workspace workspace = workspace_of(scene, integrator);
    State state = scene.initial;
    for (int k = 0; k < 200; ++k) REQUIRE(step(workspace, h, state).status == Status::ok);
    return state.x(0, swing);
  };
  const Integrator& bdf2 = *std::find_if(integrators().begin(), integrators().end(),
                                         [](const Integrator& own) { return own.name == "bdf2"; });
  const double free = end_of(bdf2, 100);
  constexpr double a_step = h * h / 2 * 10, most = 6 * a_step;  // m, of implicit Euler; those about a stop
  for (int i = 0; i < 12; ++i) {
    const double limit = 0.1003 + 0.0017 * i;
    INFO("stopped at " << limit);
    CHECK(std::abs(end_of(bdf2, limit) - free) <= most);
  }
}
