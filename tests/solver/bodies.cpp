// Rigid bodies in a step, against identities of the schemes.
#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "step/integrators.h"
#include "step/step.h"

using namespace pbd;

namespace {

const Vec3 inertia(1, 2, 3);

Method body_method(std::string_view integrator) {
  Method method;
  method.integrator = integrator;
  method.relaxation = "direct";
  method.tolerance = 1e-13;
  return method;
}

Scene top(const Vec3& spin, bool implicit) {
  Scene scene;
  add_body(scene, Vec3(1, 2, 3), 2, inertia, Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5), Vec3(1, 0, -1), spin);
  scene.effects.emplace_back(Gyroscopic{implicit});
  return scene;
}

double rotation_energy(const Vec3& spin) {
  return 0.5 * spin.dot(inertia.cwiseProduct(spin));
}

/// World to body 0; a pendulum of two bodies with a ball and a hinge.
Scene hung_pair(bool doubled = false) {
  Scene scene;
  const int world = add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
  const int first = add_body(scene, Vec3(0.5, 0, 0), 1.5, Vec3(0.01, 0.12, 0.12));
  const int second = add_body(scene, Vec3(1, 0.4, 0), 0.7, Vec3(0.09, 0.02, 0.1),
                              Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Vec3::UnitZ())), Vec3(0, 0, 0.3),
                              Vec3(0.2, 0.1, 0.4));
  scene.effects.emplace_back(Gravity{});
  scene.effects.emplace_back(Gyroscopic{});
  const Eigen::Matrix3d turned = scene.initial.orientation[second].toRotationMatrix();
  PointJoint balls{.body = {{world, first}, {first, second}},
                   .point = {{Vec3::Zero(), Vec3(-0.5, 0, 0)},
                             {Vec3(0.5, 0, 0), turned.transpose() * (Vec3(1, 0, 0) - Vec3(1, 0.4, 0))}},
                   .compliance = {0, 0}};
  AxisJoint hinge{.body = {{world, first}}, .axis = {{Vec3::UnitY(), Vec3::UnitY()}}, .compliance = {0}};
  if (doubled) {
    balls.body.push_back(balls.body[1]), balls.point.push_back(balls.point[1]);
    balls.compliance.push_back(0);
    hinge.body.push_back(hinge.body[0]), hinge.axis.push_back({-Vec3::UnitY(), -Vec3::UnitY()});
    hinge.compliance.push_back(0);
  }
  scene.effects.emplace_back(balls);
  scene.effects.emplace_back(hinge);
  return scene;
}

State run_bodies(const Scene& scene, const Method& method, double h, int steps) {
  Workspace workspace(scene, method);
  State state = scene.initial;
  for (int k = 0; k < steps; ++k) {
    const Report report = step(workspace, h, state);
    INFO("step " << k << ": " << report.reason << ", residual " << report.residual() << " after "
                 << report.outer_iterations << " iterations, contraction " << report.contraction);
    CHECK(report.status == Status::ok);
  }
  return state;
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

TEST_CASE("joints hold under every relaxation and outer iteration, and all agree") {
  const Scene scene = hung_pair();
  const State expected = run_bodies(scene, body_method("implicit_euler"), 0.01, 20);
  for (const std::string outer : {"auto", "plain", "proximal", "quasi_newton"})
    for (const std::string relaxation :
         {"gauss_seidel", "jacobi", "nesterov_jacobi", "conjugate_gradients", "direct"}) {
      INFO(outer << " " << relaxation);
      Method method = body_method("implicit_euler");
      method.outer = outer;
      method.relaxation = relaxation;
      method.tolerance = 1e-11;
      method.max_sweeps = 20000;
      const State end = run_bodies(scene, method, 0.01, 20);
      CHECK((end.x - expected.x).cwiseAbs().maxCoeff() < 1e-9);
      CHECK((end.spin - expected.spin).cwiseAbs().maxCoeff() < 1e-8);
    }
}

TEST_CASE("rotating and translating a whole scene of bodies changes nothing") {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(1.1, Vec3(1, 2, -1).normalized()));
  const Vec3 shift(3, -2, 1);
  Scene scene = hung_pair();
  Scene moved = scene;
  for (int node = 0; node < scene.nodes(); ++node) {
    moved.initial.x.col(node) = turn * scene.initial.x.col(node) + shift;
    moved.initial.v.col(node) = turn * scene.initial.v.col(node);
  }
  for (auto& orientation : moved.initial.orientation) orientation = turn * orientation;
  std::get<Gravity>(moved.effects[0]).acceleration = turn * Vec3(0, 0, -9.81);
  const State end = run_bodies(scene, body_method("implicit_euler"), 0.01, 50);
  const State other = run_bodies(moved, body_method("implicit_euler"), 0.01, 50);
  for (int node = 0; node < scene.nodes(); ++node)
    CHECK((turn * end.x.col(node) + shift - other.x.col(node)).norm() < 1e-11);
  CHECK((end.spin - other.spin).cwiseAbs().maxCoeff() < 1e-10);
}

TEST_CASE("a doubled joint changes no motion") {
  const State once = run_bodies(hung_pair(), body_method("implicit_euler"), 0.01, 50);
  const State twice = run_bodies(hung_pair(true), body_method("implicit_euler"), 0.01, 50);
  CHECK((once.x - twice.x).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("a body hung from a compliant joint sinks by m g A") {
  Scene scene;
  add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
  add_body(scene, Vec3(0, 0, -1), 2, Vec3(0.1, 0.1, 0.1));
  scene.effects.emplace_back(Gravity{});
  scene.effects.emplace_back(PointJoint{{{0, 1}}, {{Vec3::Zero(), Vec3(0, 0, 1)}}, {1e-4}});
  const State end =
      run_bodies(scene, body_method("implicit_euler"), 0.1, 200);  // implicit Euler comes to rest
  CHECK(end.x(2, 1) == Approx(-1 - 2 * 9.81 * 1e-4).epsilon(1e-9));
}

TEST_CASE("a motor turns a hinge at its rate") {
  Scene scene;
  add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
  add_body(scene, Vec3(0.5, 0, 0), 2, Vec3(0.1, 0.1, 0.1));
  scene.effects.emplace_back(PointJoint{{{0, 1}}, {{Vec3::Zero(), Vec3(-0.5, 0, 0)}}, {0}});
  scene.effects.emplace_back(AxisJoint{{{0, 1}}, {{Vec3::UnitZ(), Vec3::UnitZ()}}, {0}});
  scene.effects.emplace_back(
      AngleJoint{{{0, 1}}, {Vec3::UnitZ()}, {{Vec3::UnitX(), Vec3::UnitX()}}, {0}, {3.0}, {0}});
  const State end = run_bodies(scene, body_method("implicit_euler"), 0.01, 150);  // 4.5 rad
  const Vec3 expected(0.5 * std::cos(4.5), 0.5 * std::sin(4.5), 0);
  CHECK((end.x.col(1) - expected).norm() < 1e-10);
}

TEST_CASE("a rope of nodes hangs from a body by an attachment") {
  Scene scene;
  add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
  add_body(scene, Vec3(0, 0, -1), 2, Vec3(0.1, 0.2, 0.15));
  add_node(scene, Vec3(0.5, 0, -1), 0.3);
  add_node(scene, Vec3(1, 0, -1), 0.3);
  scene.effects.emplace_back(Gravity{});
  scene.effects.emplace_back(Gyroscopic{});
  scene.effects.emplace_back(PointJoint{{{0, 1}}, {{Vec3::Zero(), Vec3(0, 0, 1)}}, {0}});
  scene.effects.emplace_back(Attachment{{1}, {2}, {Vec3(0.5, 0, 0)}, {0}});
  scene.effects.emplace_back(Distance{{{2, 3}}, {0.5}, {0}});
  const State end = run_bodies(scene, body_method("implicit_euler"), 0.01, 100);
  const Vec3 held = end.x.col(1) + end.orientation[1] * Vec3(0.5, 0, 0);
  CHECK((end.x.col(2) - held).norm() < 1e-11);
  CHECK((end.x.col(2) - Vec3(0.5, 0, -1)).norm() > 0.05);  // it has moved
}

TEST_CASE("a motor of limited torque turns a free rotor no faster than the torque allows") {
  Scene scene;
  add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
  add_body(scene, Vec3::Zero(), 2, Vec3(0.1, 0.1, 0.1));
  scene.effects.emplace_back(PointJoint{{{0, 1}}, {{Vec3::Zero(), Vec3::Zero()}}, {0}});
  scene.effects.emplace_back(AxisJoint{{{0, 1}}, {{Vec3::UnitZ(), Vec3::UnitZ()}}, {0}});
  scene.effects.emplace_back(AngleJoint{
      {{0, 1}}, {Vec3::UnitZ()}, {{Vec3::UnitX(), Vec3::UnitX()}}, {0}, {1.0}, {0}, {}, {{-0.05, 0.05}}});
  const State end = run_bodies(scene, body_method("implicit_euler"), 0.01, 50);
  CHECK(end.spin(2, 1) == Approx(0.5 * 0.05 / 0.1).epsilon(1e-10));  // t torque / I, below the rate
}

TEST_CASE("a body that hangs still is held by its weight, whatever the integrator") {
  for (const Integrator& integrator : integrators()) {
    INFO(integrator.name);
    Scene scene;
    add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
    add_body(scene, Vec3(0, 0, -1), 2, Vec3(0.1, 0.1, 0.1));
    scene.effects.emplace_back(Gravity{});
    scene.effects.emplace_back(PointJoint{{{0, 1}}, {{Vec3::Zero(), Vec3(0, 0, 1)}}, {0}});
    const Method method = body_method(integrator.name);
    Workspace workspace(scene, method);
    State state = scene.initial;
    for (int k = 0; k < 4; ++k) CHECK(step(workspace, 0.01, state).status == Status::ok);
    const std::vector<double> force = workspace.forces(1);
    REQUIRE(force.size() == 3);
    CHECK(std::abs(force[0]) < 1e-9);
    CHECK(force[2] == Approx(2 * 9.81).epsilon(1e-9));
  }
}

TEST_CASE("forces that act as given ones are not known as multipliers") {
  Scene scene;
  add_node(scene, Vec3::Zero(), 1);
  add_node(scene, Vec3::UnitX(), 3);
  scene.effects.emplace_back(Gravity{});
  scene.effects.emplace_back(Anchor{{0, 1}, {Vec3::Zero(), Vec3::UnitX()}, {1e-3, 0}});
  const Method method = body_method("symplectic_euler");
  Workspace workspace(scene, method);
  State state = scene.initial;
  step(workspace, 0.001, state);
  const std::vector<double> force = workspace.forces(1);
  REQUIRE(force.size() == 6);
  CHECK(std::isnan(force[2]));
  CHECK(force[5] == Approx(3 * 9.81).epsilon(1e-9));
}
