// Rigid bodies and nodes held by joints, attachments and motors.
#include <limits>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "body_runs.h"
#include "linear/linear_names.h"
#include "outer/outer_names.h"
#include "step/integrators.h"

using namespace pbd;
using namespace pbd::test;

namespace {

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

}  // namespace

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

TEST_CASE("forces that act as given ones are not known as multipliers, wherever they stand in the effect") {
  Scene scene;
  add_node(scene, Vec3::Zero(), 1);
  add_node(scene, Vec3::UnitX(), 3);
  scene.effects.emplace_back(Gravity{});
  const std::vector<double> compliance =
      GENERATE(std::vector{1e-3, 0.0}, std::vector{0.0, 1e-3}, std::vector{1e-3, 1e-3});
  scene.effects.emplace_back(Anchor{{0, 1}, {Vec3::Zero(), Vec3::UnitX()}, compliance});
  const Method method = body_method("symplectic_euler");
  Workspace workspace(scene, method);
  State state = scene.initial;
  step(workspace, 0.001, state);
  const std::vector<double> force = workspace.forces(1);
  REQUIRE(force.size() == 6);
  for (const std::size_t node : {0U, 1U})
    if (compliance[node] > 0)
      CHECK(std::isnan(force[3 * node + 2]));
    else
      CHECK(force[3 * node + 2] == Approx(scene.mass[node] * 9.81).epsilon(1e-9));
}

TEST_CASE("the size of what is fixed is no excuse for a joint's error") {
  // Its value is a difference of lengths of 0.1 m, rounded as such.
  constexpr double length = 0.1, mass = 1;
  Scene scene;
  const int ground = add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
  const int top = add_body(scene, Vec3(0, 0, length), mass, Vec3(0.0025, 0.0025, 0.005),
                           Eigen::Quaterniond::Identity(), Vec3(0, 0.02, 0), Vec3(-0.2, 0, 100));
  scene.effects = {
      Gravity{}, Gyroscopic{},
      PointJoint{.body = {{ground, top}}, .point = {{Vec3::Zero(), Vec3(0, 0, -length)}}, .compliance = {0}}};
  Method method;
  method.integrator = "symplectic_euler";
  method.relaxation = "direct";
  method.tolerance = 1e-12;
  // Where the iterates happen to arrive well below their bound, too large a bound is not seen.
  for (const double h : {1e-4, 1.5e-4, 2e-4, 2.5e-4, 3e-4, 4e-4, 5e-4, 7e-4, 1e-3}) {
    CAPTURE(h);
    Workspace workspace(scene, method);
    State state = scene.initial;
    const Report report = step(workspace, h, state);
    REQUIRE(report.status == Status::ok);
    // Three rows' errors of 8 units in the last place, of which each costs the mass at most.
    const double rounding = std::sqrt(3 * mass) * 8 * std::numeric_limits<double>::epsilon() * length / h;
    CHECK((report.dual - method.tolerance * report.scale) / rounding <= 1);
  }
}
