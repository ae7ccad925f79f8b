// Limits that have no rows while nothing comes near them.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "body_scenes.h"
#include "error.h"
#include "scenes/contacts.h"
#include "step/step.h"

using namespace pbd;
using namespace pbd::test;

namespace {

constexpr double waiting_step_s = 0.01;  // s
const std::vector<std::array<int, 2>> two_bodies{{0, 1}};
const std::vector<ForceBounds> idle_above_0{{0, infinity}};

double swung_to(const State& state) {
  return std::atan2(-state.x(2, 1), state.x(0, 1));
}

}  // namespace

TEST_CASE("a limit that nothing comes near has no row and no force, and changes no bit") {
  const Scene free_scene = [] {
    Scene scene;
    add_world(scene);
    add_body(scene, Vec3(1, 0, 0), 1, Vec3(0.1, 0.2, 0.3), Eigen::Quaterniond::Identity(), Vec3(0, 1, 0),
             Vec3(1, 2, 3));
    scene.effects.emplace_back(Gravity{});
    scene.effects.emplace_back(Gyroscopic{});
    return scene;
  }();
  Scene roped = free_scene;
  const std::vector<ForceBounds> below{{-infinity, 0}};
  roped.effects.emplace_back(
      BodyDistance{two_bodies, {{Vec3(0, 0, 0), Vec3(0.1, 0, 0)}}, {9}, {0}, {}, below});
  Workspace alone(free_scene, {}), with(roped, {});
  State expected = free_scene.initial, state = roped.initial;
  for (int k = 0; k < 100; ++k) {
    CHECK(step(alone, waiting_step_s, expected).status == Status::ok);
    CHECK(step(with, waiting_step_s, state).status == Status::ok);
    CHECK(with.costs().at(0).rows == 0);
    CHECK(with.forces(2) == std::vector<double>{0});
    CHECK(with.impulses(2) == std::vector<double>{0});
  }
  CHECK(state.x == expected.x);
  CHECK(state.v == expected.v);
  CHECK(state.spin == expected.spin);
}

TEST_CASE("a limit that waits holds what a collision throws beyond it within the step") {
  pbdcheck::BodyScene build({.friction = 0});
  const int held = build.ball(0.1, 1, {Vec3(0.9, 0, 0)});
  build.ball(0.1, 1, {Vec3(0.2, 0, 0), Eigen::Quaterniond::Identity(), Vec3(60, 0, 0)});
  Scene scene = build.finish();
  std::erase_if(scene.effects, [](const Effect& effect) { return std::holds_alternative<Gravity>(effect); });
  const std::array<Vec3, 2> centres{Vec3(0, 0, 0), Vec3(0, 0, 0)};
  const int world = add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
  const std::vector<ForceBounds> below{{-infinity, 0}};
  scene.effects.emplace_back(BodyDistance{{{world, held}}, {centres}, {0.92}, {0}, {}, below});
  for (const std::string relaxation : {"gauss_seidel", "conjugate_gradients", "direct"}) {
    INFO(relaxation);
    Method method;
    method.relaxation = relaxation;
    Workspace workspace(scene, method);
    State state = scene.initial;
    CHECK(step(workspace, waiting_step_s, state).status == Status::ok);
    const Vec3 at = state.x.col(scene.bodies[static_cast<std::size_t>(held)].node);
    CHECK(at.norm() == Approx(0.92).epsilon(1e-6));
    CHECK(workspace.forces(scene.effects.size() - 1).at(0) < 0);
  }
}

TEST_CASE("limits that wait stop what comes to them slowly or fast, and wait again") {
  const auto speed = GENERATE(0.01, 1.0, 30.0);  // rad/s
  constexpr double most = 1.2;                   // rad
  Scene scene;
  add_world(scene);
  add_body(scene, Vec3(0.5, 0, 0), 2, Vec3(1e-3, 2.0 / 12, 2.0 / 12), Eigen::Quaterniond::Identity(),
           Vec3(0, 0, -0.5 * speed), Vec3(0, speed, 0));
  const Vec3 y = Vec3::UnitY(), x = Vec3::UnitX();
  scene.effects.emplace_back(PointJoint{two_bodies, {{Vec3::Zero(), Vec3(-0.5, 0, 0)}}, {0}});
  scene.effects.emplace_back(AxisJoint{two_bodies, {{y, y}}, {0}});
  scene.effects.emplace_back(AngleJoint{{{0, 1}, {0, 1}},
                                        {y, y},
                                        {{x, x}, {x, x}},
                                        {-most, most},
                                        {0, 0},
                                        {0, 0},
                                        {},
                                        {{0, infinity}, {-infinity, 0}}});
  Workspace workspace(scene, {});
  State state = scene.initial;
  const double turn = speed * waiting_step_s;
  INFO(speed << " rad/s");
  // From 0 to one stop, and back to the other.
  for (const auto& [way, stop] : {std::pair{most, 1}, std::pair{2 * most, 0}}) {
    const double sign = stop == 1 ? 1 : -1;
    state.spin.col(1) = Vec3(0, sign * speed, 0);
    state.v.col(1) = state.spin.col(1).cross(state.x.col(1));
    const int steps = static_cast<int>(1.5 * way / turn) + 2;
    std::int64_t rows = 0, least = 2;
    int held = 0;
    for (int k = 0; k < steps; ++k) {
      CHECK(step(workspace, waiting_step_s, state).status == Status::ok);
      CHECK(std::abs(swung_to(state)) <= most + 1e-8);
      rows += workspace.costs().at(2).rows;
      least = std::min(least, workspace.costs().at(2).rows);
      held += workspace.forces(2)[static_cast<std::size_t>(stop)] != 0;
    }
    CHECK(held > 0);
    CHECK(swung_to(state) == Approx(sign * most).epsilon(1e-6));
    if (turn < 0.02) CHECK(rows < steps);  // of two a step: each limit waits most of the time
    if (turn < 0.02) CHECK(least == 0);
  }
}

TEST_CASE("a limit that waits is looked at anew where it is changed") {
  Scene scene = linked_body(1, 2, 0, {{-infinity, 0}});
  Workspace workspace(scene, {});
  State state = scene.initial;
  const auto rope = std::find_if(scene.effects.begin(), scene.effects.end(), [](const Effect& effect) {
    return std::holds_alternative<BodyDistance>(effect);
  });
  const auto index = static_cast<std::size_t>(rope - scene.effects.begin());
  CHECK(step(workspace, waiting_step_s, state).status == Status::ok);
  CHECK(workspace.costs().at(0).rows == 0);
  auto shorter = std::get<BodyDistance>(*rope);
  shorter.rest_length = {0.9};
  workspace.change(index, shorter);
  CHECK(step(workspace, waiting_step_s, state).status == Status::ok);
  CHECK(workspace.costs().at(0).rows == 1);
  CHECK(workspace.forces(index)[0] < 0);
}

TEST_CASE("ropes that wait take no other bodies or number, and stop what they stopped") {
  Scene scene;
  add_world(scene);
  for (const double y : {0.0, 5.0})
    add_body(scene, Vec3(1, y, 0), 1, Vec3::Ones(), Eigen::Quaterniond::Identity(), Vec3(1, 0, 0));
  const std::array<Vec3, 2> centres{Vec3(0, 0, 0), Vec3(0, 0, 0)};
  const BodyDistance ropes{{{0, 1}, {1, 2}}, {centres, centres}, {1.5, 8}, {0, 0}, {}, {2, {-infinity, 0}}};
  scene.effects.emplace_back(ropes);
  Workspace workspace(scene, {});
  State state = scene.initial;
  CHECK(step(workspace, waiting_step_s, state).status == Status::ok);
  CHECK(workspace.costs().at(0).rows == 0);
  BodyDistance other = ropes;
  SECTION("other bodies") {
    other.body[0] = {0, 2};
  }
  SECTION("one rope less") {
    other.body.pop_back(), other.point.pop_back(), other.rest_length.pop_back();
    other.compliance.pop_back(), other.bounds.pop_back();
  }
  SECTION("one that gives way") {
    other.compliance[0] = 1e-3;
  }
  CHECK_THROWS_AS(workspace.change(0, other), SetupError);
  for (int k = 0; k < 100; ++k) {
    CHECK(step(workspace, waiting_step_s, state).status == Status::ok);
    CHECK(state.x.col(1).norm() <= 1.5 + 1e-8);
  }
  CHECK(state.x.col(1).norm() > 1.4);
}

TEST_CASE("a limit that is made a motor between steps drives from then on") {
  Scene scene;
  add_world(scene);
  add_body(scene, Vec3(1, 0, 0), 1, Vec3::Ones());
  const std::array<Vec3, 2> centres{Vec3(0, 0, 0), Vec3(0, 0, 0)};
  SlideJoint slide{two_bodies, {centres}, {Vec3::UnitX()}, {0}, {0}, {0}, {}, idle_above_0};
  scene.effects.emplace_back(slide);
  Workspace workspace(scene, {});
  State state = scene.initial;
  if (GENERATE(true, false)) {
    CHECK(step(workspace, waiting_step_s, state).status == Status::ok);
    CHECK(workspace.forces(0) == std::vector<double>{0});
  }
  slide.bounds = {{-5, 5}};
  slide.rest_position = {2};
  workspace.change(0, slide);
  CHECK(step(workspace, waiting_step_s, state).status == Status::ok);
  CHECK(workspace.forces(0).at(0) == Approx(5).epsilon(1e-12));
}

TEST_CASE("a limit that waits is called before it is reached where no iterate is near a solution") {
  Scene scene = rod_chain(20);  // turns; one sweep a step leaves it far from solved
  std::erase_if(scene.effects, [](const Effect& effect) { return std::holds_alternative<Gravity>(effect); });
  const int body =
      add_body(scene, Vec3::Zero(), 1, Vec3::Ones(), Eigen::Quaterniond::Identity(), Vec3(1, 0, 0));
  const std::vector<ForceBounds> below{{-infinity, 0}};
  const std::array<Vec3, 2> centres{Vec3(0, 0, 0), Vec3(0, 0, 0)};
  scene.effects.emplace_back(SlideJoint{{{0, body}}, {centres}, {Vec3::UnitX()}, {1}, {0}, {0}, {}, below});
  Method method;
  method.outer = "plain";
  method.relaxation = "gauss_seidel";
  method.max_outer = method.max_sweeps = 1;
  Workspace workspace(scene, method);
  State state = scene.initial;
  std::int64_t rows = 0;
  for (int k = 0; k < 150; ++k) {
    CHECK(step(workspace, waiting_step_s, state).status == Status::not_converged);
    CHECK(state.x(0, scene.bodies[static_cast<std::size_t>(body)].node) <= 1 + 1e-9);
    rows += workspace.costs().back().rows;
  }
  CHECK(state.x(0, scene.bodies[static_cast<std::size_t>(body)].node) == Approx(1).epsilon(1e-9));
  CHECK(rows <= 50 + 8);  // it rests for 50 steps, and 4 of both bodies are 8 of one
}

TEST_CASE("a stop that waits holds a ball that friction turns past it by a whole turn in a step") {
  constexpr double most = 1;  // rad
  const auto down =
      GENERATE(9.6, 9.8, 10.04, 10.4);  // m/s; friction makes 25 rad/s of each, at 1/40 s a turn
  pbdcheck::BodyScene build({.friction = 1});
  build.ground();
  const int ball = build.ball(0.1, 1, {Vec3(0, 0, 0.101), Eigen::Quaterniond::Identity(), Vec3(0, 0, -down)});
  Scene scene = build.finish();
  for (Effect& effect : scene.effects)
    if (auto* contact = std::get_if<Contact>(&effect))
      contact->collider[0].surface_velocity = Vec3(400, 0, 0);
  const Vec3 y = Vec3::UnitY(), x = Vec3::UnitX();
  scene.effects.emplace_back(
      AngleJoint{{{add_world(scene), ball}}, {y}, {{x, x}}, {-most}, {0}, {0}, {}, idle_above_0});
  INFO(down << " m/s");
  for (const std::string integrator : {"implicit_euler", "bdf2", "newmark", "generalised_alpha"}) {
    INFO(integrator);
    Method method;
    method.integrator = integrator;
    Workspace workspace(scene, method);
    State state = scene.initial;
    CHECK(step(workspace, 0.025, state).status == Status::ok);
    const Vec3 turned = state.orientation[static_cast<std::size_t>(ball)] * x;
    CHECK(std::atan2(-turned.z(), turned.x()) >= -most - 1e-6);
    CHECK(workspace.forces(scene.effects.size() - 1).at(0) > 0);
  }
}
