// Rigid bodies in a step, against identities of the schemes.
#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "body_runs.h"
#include "step/integrators.h"

using namespace pbd;
using namespace pbd::test;

namespace {

const Vec3 inertia(1, 2, 3);

Scene top(const Vec3& spin, bool implicit) {
  Scene scene;
  add_body(scene, Vec3(1, 2, 3), 2, inertia, Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5), Vec3(1, 0, -1), spin);
  scene.effects.emplace_back(Gyroscopic{implicit});
  return scene;
}

double rotation_energy(const Vec3& spin) {
  return 0.5 * spin.dot(inertia.cwiseProduct(spin));
}

}  // namespace

TEST_CASE("a torque-free body loses and gains the energy that its scheme says") {
  const Vec3 spin(1, 1, 1);
  const double h = 0.05;
  const auto gain = [&](std::string_view integrator, bool implicit, Vec3& change) {
    const Scene scene = top(spin, implicit);
    const State end = run_bodies(scene, body_method(integrator), h, 1);
    change = end.spin.col(0) - spin;
    return rotation_energy(end.spin.col(0)) - rotation_energy(spin);
  };
  Vec3 change;
  // Implicit: w' . I (w' - w) = 0, so that the loss is 1/2 dw . I dw; explicit: w . I (w' - w) = 0, a gain.
  const double loss = gain("implicit_euler", true, change);
  CHECK(change.norm() > 0.01);
  CHECK(loss == Approx(-rotation_energy(change)).epsilon(1e-10));
  const double gained = gain("implicit_euler", false, change);
  CHECK(gained == Approx(rotation_energy(change)).epsilon(1e-10));
  // At the middle: (w' + w) . I (w' - w) = 0.
  CHECK(std::abs(gain("midpoint", true, change)) < 1e-13);
}

TEST_CASE("the middle's gyroscopic torque keeps the length of the angular momentum") {
  const Scene scene = top(Vec3(0.1, 2, 0.05), true);
  const State end = run_bodies(scene, body_method("midpoint"), 0.02, 500);
  const double before = inertia.cwiseProduct(scene.initial.spin.col(0)).norm();
  CHECK(inertia.cwiseProduct(end.spin.col(0)).norm() == Approx(before).epsilon(1e-12));
}

// Where a body turns by radians in a step the equation may have far solutions or be missed; never in silence.
TEST_CASE("a step that says ok has found its gyroscopic torque") {
  constexpr double h = 0.05;
  const Method method = body_method("midpoint");
  int solved = 0;
  for (int k = 0; k < 200; ++k) {
    const double speed = 0.1 * std::pow(1.05, k) / h;  // h |w| up to 1600
    const Scene scene =
        top(speed * Vec3(std::sin(2.1 * k), std::sin(3.3 * k + 1), std::sin(4.7 * k + 2)), true);
    Workspace workspace(scene, method);
    State state = scene.initial;
    const Report report = step(workspace, h, state);
    INFO("h |w| about " << h * speed);
    if (h * speed < 0.5) CHECK(report.status == Status::ok);
    if (report.status != Status::ok) continue;
    ++solved;
    const double before = rotation_energy(scene.initial.spin.col(0));
    CHECK(rotation_energy(state.spin.col(0)) == Approx(before).epsilon(1e-9));
  }
  CHECK(solved > 40);
}

// All of the rod's inertia about its own axis is 2e-6 of that across it.
TEST_CASE("a slender rod swings under every outer iteration") {
  Scene scene;
  constexpr double length = 1, radius = 1e-3, h = 0.01;
  const int world = add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
  const Vec3 moments(length * length / 12, length * length / 12, radius * radius / 2);
  const int rod = add_body(scene, Vec3(0, 0, length / 2), 1, moments, Eigen::Quaterniond::Identity(),
                           Vec3(5, 0, 0), Vec3(0, 10, 5));
  scene.effects.emplace_back(Gravity{});
  scene.effects.emplace_back(Gyroscopic{});
  scene.effects.emplace_back(PointJoint{
      .body = {{world, rod}}, .point = {{Vec3::Zero(), Vec3(0, 0, -length / 2)}}, .compliance = {0}});
  for (const std::string outer : {"plain", "proximal", "auto"}) {
    INFO(outer);
    Method method = body_method("implicit_euler");
    method.tolerance = 1e-10;
    method.outer = outer;
    run_bodies(scene, method, h, 30);
  }
}

TEST_CASE("without the gyroscopic torque a body's angular velocity stays as it is in its frame") {
  Scene scene = top(Vec3(1, 2, 3), true);
  scene.effects.clear();
  const State end = run_bodies(scene, body_method("implicit_euler"), 0.1, 10);
  CHECK(end.spin.col(0) == scene.initial.spin.col(0));
  const double angle = Vec3(1, 2, 3).norm();
  const Eigen::Quaterniond expected =
      scene.initial.orientation[0] * Eigen::AngleAxisd(angle, Vec3(1, 2, 3).normalized());
  CHECK(expected.angularDistance(end.orientation[0]) < 1e-12);
}

TEST_CASE("a torque changes the angular velocity by h I^-1 of it in the body's axes") {
  Scene scene;
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.8, Vec3(1, -1, 2).normalized()));
  add_body(scene, Vec3::Zero(), 3, inertia, turn);
  scene.effects.emplace_back(ExternalTorque{{0}, {Vec3(0.3, -0.2, 0.5)}});
  const double h = 0.01;
  const State end = run_bodies(scene, body_method("implicit_euler"), h, 1);
  const Vec3 expected = h * (turn.conjugate() * Vec3(0.3, -0.2, 0.5)).cwiseQuotient(inertia);
  CHECK((end.spin.col(0) - expected).norm() < 1e-15);
}
