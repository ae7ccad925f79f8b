// Limits of joints.
#include <catch2/catch.hpp>

#include "body_scenes.h"
#include "error.h"
#include "step/integrators.h"
#include "step/step.h"

using namespace pbd;
using namespace pbd::test;

namespace {

/// A bar of 1 m hinged at its end to the world, let go horizontally, that a limit stops `lower` rad from
/// there.
Scene stopped_bar(double lower, double upper) {
  Scene scene;
  add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
  add_body(scene, Vec3(0.5, 0, 0), 2, Vec3(1e-3, 2.0 / 12, 2.0 / 12));
  scene.effects.emplace_back(Gravity{});
  scene.effects.emplace_back(Gyroscopic{});
  scene.effects.emplace_back(PointJoint{{{0, 1}}, {{Vec3::Zero(), Vec3(-0.5, 0, 0)}}, {0}});
  scene.effects.emplace_back(AxisJoint{{{0, 1}}, {{Vec3::UnitY(), Vec3::UnitY()}}, {0}});
  const auto angle = [](double rest, ForceBounds bounds) {
    return AngleJoint{{{0, 1}}, {Vec3::UnitY()}, {{Vec3::UnitX(), Vec3::UnitX()}}, {rest}, {0}, {0},
                      {},       {bounds}};
  };
  scene.effects.emplace_back(angle(lower, {0, infinity}));
  scene.effects.emplace_back(angle(upper, {-infinity, 0}));
  return scene;
}

}  // namespace

TEST_CASE("a limit stops a hinge, pushes only while it is reached, and holds the weight's torque") {
  // Falling turns the bar by positive angles about y, from 0 to the limit at 0.6 rad.
  const Scene scene = stopped_bar(-0.1, 0.6);
  for (const std::string outer : {"auto", "plain", "proximal"})
    for (const std::string relaxation :
         {"gauss_seidel", "jacobi", "nesterov_jacobi", "conjugate_gradients", "direct"}) {
      INFO(outer << " " << relaxation);
      Method method;
      method.integrator = "implicit_euler";
      method.outer = outer;
      method.relaxation = relaxation;
      method.tolerance = 1e-10;
      method.max_sweeps = 20000;
      const double h = 0.01;
      Workspace workspace(scene, method);
      State state = scene.initial;
      double largest = 0;
      for (int k = 0; k < 200; ++k) {
        CHECK(step(workspace, h, state).status == Status::ok);
        const double lower = workspace.impulses(4)[0], upper = workspace.impulses(5)[0];
        CHECK(lower == 0);
        CHECK(upper <= 0);
        const double angle = std::atan2(-state.x(2, 1), state.x(0, 1));
        largest = std::max(largest, angle);
        if (upper < 0) CHECK(angle == Approx(0.6).epsilon(1e-9));
      }
      CHECK(largest < 0.6 + 1e-9);
      // At rest against the limit: torque m g l/2 cos(angle) = -gamma.
      CHECK(workspace.impulses(5)[0] / h == Approx(-2 * 9.81 * 0.5 * std::cos(0.6)).epsilon(1e-8));
    }
}

TEST_CASE("limits nearly half a turn apart hold a bar that meets them at any speed") {
  // A solver's iterates may pass a limit, by which the other one is more than half a turn away.
  const auto speed = GENERATE(10.0, 20.0, 40.0, 150.0);  // rad/s
  const auto relaxation = GENERATE(as<std::string>(), "auto", "direct", "conjugate_gradients");
  Scene scene = stopped_bar(-1.5, 1.6);
  scene.initial.spin(1, 1) = speed;
  scene.initial.v(2, 1) = -0.5 * speed;
  const auto energy = [&](const State& state) {
    return state.v.col(1).squaredNorm() + 2 * 9.81 * state.x(2, 1) +
           scene.bodies[1].inertia.dot(state.spin.col(1).cwiseAbs2()) / 2;
  };
  Method method;
  if (relaxation != "auto") method.relaxation = relaxation;
  Workspace workspace(scene, method);
  State state = scene.initial;
  const double start = energy(state);
  INFO(speed << " rad/s by " << relaxation);
  for (int k = 0; k < 100; ++k) {
    CHECK(step(workspace, 0.01, state).status == Status::ok);
    const double angle = std::atan2(-state.x(2, 1), state.x(0, 1));
    CHECK(angle <= 1.6 + 1e-8);
    CHECK(angle >= -1.5 - 1e-8);
    CHECK(energy(state) <= start * (1 + 1e-8));
  }
}

TEST_CASE("limits that exclude each other are not met, by any solver, however large their forces grow") {
  const auto outer = GENERATE(as<std::string>(), "auto", "plain", "proximal");
  const auto relaxation = GENERATE(as<std::string>(), "gauss_seidel", "jacobi", "nesterov_jacobi",
                                   "conjugate_gradients", "direct");
  const bool turns = GENERATE(false, true);
  Scene scene;
  const int world = add_world(scene), body = add_body(scene, Vec3(0.3, 0.1, 0), 1, Vec3::Constant(0.1));
  const std::vector<ForceBounds> bounds{{-infinity, 0}, {0, infinity}};  // at most -1 and at least 1
  const std::vector<std::array<int, 2>> both(2, {world, body});
  if (turns)
    scene.effects.emplace_back(AngleJoint{.body = both,
                                          .axis = {Vec3::UnitY(), Vec3::UnitY()},
                                          .reference = {2, {Vec3::UnitX(), Vec3::UnitX()}},
                                          .rest_angle = {-1, 1},
                                          .rate = {0, 0},
                                          .compliance = {0, 0},
                                          .bounds = bounds});
  else
    scene.effects.emplace_back(SlideJoint{.body = both,
                                          .point = {2, {Vec3::Zero(), Vec3::Zero()}},
                                          .axis = {Vec3::UnitX(), Vec3::UnitX()},
                                          .rest_position = {-1, 1},
                                          .rate = {0, 0},
                                          .compliance = {0, 0},
                                          .bounds = bounds});
  Method method;
  method.outer = outer;
  method.relaxation = relaxation;
  Workspace workspace(scene, method);
  State state = scene.initial;
  INFO(outer << " " << relaxation << (turns ? " angle" : " slide"));
  for (int k = 0; k < 20; ++k) {
    CHECK(step(workspace, 0.01, state).status != Status::ok);
    if (!turns) CHECK(std::abs(state.x(0, 1)) <= 1 + 1e-9);  // it began between them
  }
}

TEST_CASE("a motor of limited torque works on an arm that rests on its limit, by every linear solver") {
  constexpr double h = 0.005, most_torque = 1, most_angle = 0.3;  // s, N m, rad
  Scene scene;
  add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
  for (const auto& [x, mass] : {std::pair{0.2, 2.0}, std::pair{0.6, 1.0}})
    add_body(scene, Vec3(x, 0, 0), mass, mass / 12 * Vec3(0.02, 0.17, 0.17));  // bars of 0.4 x 0.1 x 0.1 m
  scene.effects.emplace_back(Gravity{});
  scene.effects.emplace_back(Gyroscopic{});
  scene.effects.emplace_back(PointJoint{
      {{0, 1}, {1, 2}}, {{Vec3::Zero(), Vec3(-0.2, 0, 0)}, {Vec3(0.2, 0, 0), Vec3(-0.2, 0, 0)}}, {0, 0}});
  const Vec3 y = Vec3::UnitY(), x = Vec3::UnitX();
  scene.effects.emplace_back(AxisJoint{{{0, 1}, {1, 2}}, {{y, y}, {y, y}}, {0, 0}});
  scene.effects.emplace_back(AngleJoint{{{0, 1}, {1, 2}},
                                        {y, y},
                                        {{x, x}, {x, x}},
                                        {most_angle, 0},
                                        {0, -2},
                                        {0, 0},
                                        {},
                                        {{-infinity, 0}, {-most_torque, most_torque}}});
  for (const std::string relaxation :
       {"gauss_seidel", "jacobi", "nesterov_jacobi", "conjugate_gradients", "direct"}) {
    INFO(relaxation);
    Method method;
    method.relaxation = relaxation;
    Workspace workspace(scene, method);
    State state = scene.initial;
    int missed = 0, rests = 0, limited = 0;
    for (int k = 0; k < 200; ++k) {
      const Report report = step(workspace, h, state);
      missed += report.status != Status::ok;
      const std::vector<double> torque = workspace.forces(4);  // N m
      CHECK(torque[0] <= 0);
      CHECK(std::abs(torque[1]) <= most_torque * (1 + 1e-12));
      limited += std::abs(torque[1]) == Approx(most_torque).epsilon(1e-12);
      if (torque[0] == 0) continue;
      ++rests;
      CHECK(std::atan2(-state.x(2, 1), state.x(0, 1)) == Approx(most_angle).epsilon(1e-6));
    }
    CHECK(missed == 0);
    CHECK(rests > 50);
    CHECK(limited > 50);
  }
}

TEST_CASE("a slack rope does nothing, compliant or not, whatever the integrator starts with") {
  const double compliance = GENERATE(0.0, 1e-3);
  const Scene scene = linked_body(1, 2, compliance, {{-infinity, 0}});
  for (const Integrator& integrator : integrators()) {
    INFO(integrator.name);
    Method method;
    method.integrator = integrator.name;
    Workspace workspace(scene, method);
    State state = scene.initial;
    for (int k = 0; k < 3; ++k) CHECK(step(workspace, 0.01, state).status == Status::ok);
    CHECK(state.x == scene.initial.x);
    CHECK(state.v.isZero(0));
  }
}

TEST_CASE("quasi_newton refuses limits") {
  Method method;
  method.outer = "quasi_newton";
  CHECK_THROWS_AS(Workspace(stopped_bar(-0.1, 0.6), method), SetupError);
}
