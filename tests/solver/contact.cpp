// Contact in a step, against exact recurrences and balances.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "contact_runs.h"
#include "linear/linear_names.h"
#include "rows/laws.h"
#include "scenes/contacts.h"

using namespace pbd;
using namespace pbd::test;
using namespace pbdcheck;

namespace {

/// v_k+1 = max(0, v_k - h deceleration), x_k+1 = x_k + h v_k+1
double sliding_distance(double v, double deceleration, double h, int steps) {
  double x = 0;
  for (int k = 0; k < steps; ++k) {
    v = std::max(0.0, v - h * deceleration);
    x += h * v;
  }
  return x;
}

}  // namespace

TEST_CASE("a sliding box follows implicit Euler's recurrence with every relaxation and law") {
  constexpr double h = 1.0 / 60, friction = 0.3, speed = 3;
  constexpr int steps = 70;  // it stops in 61
  const double exact = sliding_distance(speed, friction * gravity, h, steps);
  for (const auto relaxation : general_solver_names())
    for (const auto law : {"coulomb", "disc", "box"}) {
      const State end = run(sliding_box(0, friction, speed), contact_method(relaxation, law), h, steps);
      INFO(relaxation << " " << law);
      CHECK(std::abs(end.x(0, 1) - exact) <= 1e-9);
      CHECK(std::abs(end.x(2, 1) - 0.05) <= 1e-10);
    }
}

TEST_CASE("friction is the same at every heading, but for the box's sqrt(2)") {
  constexpr double h = 0.01, friction = 0.3, speed = 2;
  for (const double degrees : {20.0, 45.0, 130.0}) {
    const double heading = degrees * std::numbers::pi / 180;
    const Scene scene = sliding_box(0, friction, speed, heading);
    const double exact = sliding_distance(speed, friction * gravity, h, 20);
    for (const auto law : {"coulomb", "disc"}) {
      const State end = run(scene, contact_method("conjugate_gradients", law), h, 20);
      CHECK(std::abs(end.x.col(1).head<2>().norm() - exact) <= 1e-9);
      CHECK(std::abs(std::atan2(end.x(1, 1), end.x(0, 1)) - heading) <= 1e-9);
    }
  }
  const State box = run(sliding_box(0, friction, speed, std::numbers::pi / 4),
                        contact_method("conjugate_gradients", "box"), h, 20);
  CHECK(std::abs(box.x.col(1).head<2>().norm() -
                 sliding_distance(speed, std::numbers::sqrt2 * friction * gravity, h, 20)) <= 1e-9);
}

TEST_CASE("the convex law lets a steadily sliding box hover by h mu v, Coulomb's does not") {
  constexpr double angle = 0.4, friction = 0.2, h = 0.005;
  for (const auto relaxation : {"gauss_seidel", "nesterov_jacobi", "direct"}) {
    Workspace workspace(sliding_box(angle, friction, 1), contact_method(relaxation, "cone"));
    const Scene scene = sliding_box(angle, friction, 1);
    const State end = run(scene, contact_method(relaxation, "cone"), h, 200, workspace);
    const Vec3 normal(std::sin(angle), 0, std::cos(angle));
    const double gap = normal.dot(end.x.col(1)) - 0.05, speed = end.v.col(1).norm();
    INFO(relaxation << " gap " << gap << " h mu v " << h * friction * speed);
    CHECK(std::abs(gap / (h * friction * speed) - 1) <= 0.01);
  }
}

TEST_CASE("a box sticks just below and slides just above the angle of friction") {
  constexpr double angle = 0.5, h = 0.01;
  const double tangent = std::tan(angle);
  const State sticks = run(sliding_box(angle, tangent * (1 + 1e-6), 0), contact_method("direct"), h, 100);
  CHECK(sticks.v.col(1).norm() <= 1e-9);
  const State slides = run(sliding_box(angle, tangent * (1 - 1e-6), 0), contact_method("direct"), h, 100);
  const double exact = gravity * std::sin(angle) * 1e-6 * 100 * h;
  CHECK(std::abs(slides.v.col(1).norm() / exact - 1) <= 1e-3);
}

TEST_CASE("columns stand, however heavy their tops, and the ground carries their weight") {
  for (const auto& scene : {column(5), column(2, 1e4), column(6, 4), pyramid(4)})
    for (const auto relaxation : {"conjugate_gradients", "direct"}) {
      const Method method = contact_method(relaxation);
      Workspace workspace(scene, method);
      const State end = run(scene, method, 0.01, 20, workspace);
      const Vec3 carried = ground_force(workspace);
      CHECK(std::abs(carried.z() / weight(scene) - 1) <= 1e-9);
      CHECK(carried.head<2>().norm() <= 1e-8 * weight(scene));
      CHECK((end.x - scene.initial.x).cwiseAbs().maxCoeff() <= 1e-9);
    }
}

TEST_CASE("a cube carries another of ten thousand times its mass under every relaxation") {
  const Scene scene = column(2, 1e4);
  for (const auto relaxation : general_solver_names()) {
    Method method = contact_method(relaxation);
    method.max_outer = 1000;
    Workspace workspace(scene, method);
    run(scene, method, 0.01, 5, workspace);
    CHECK(std::abs(ground_force(workspace).z() / weight(scene) - 1) <= 1e-9);
  }
}

TEST_CASE("soft ground carries a box's weight, sunk in by its share of it, under every integrator") {
  constexpr double compliance = 1e-4;
  BodyScene build({.friction = 0.5, .compliance = compliance});
  build.ground();
  build.box(Vec3(0.2, 0.2, 0.1), 4, {Vec3(0, 0, 0.05)});
  const Scene scene = build.finish();
  for (const auto& [integrator, alpha] :
       {std::pair{"implicit_euler", 1.0}, std::pair{"symplectic_euler", 1.0}, std::pair{"newmark", 0.55},
        std::pair{"newmark", 0.75}, std::pair{"bdf2", 1.0}, std::pair{"generalised_alpha", 1.0}}) {
    Method method = contact_method("direct");
    method.integrator = integrator;
    method.alpha = alpha;
    Workspace workspace(scene, method);
    const State end = run(scene, method, 0.01, 500, workspace);  // contact springs are damped by the step
    INFO(integrator << " " << alpha);
    CHECK(std::abs(ground_force(workspace).z() / weight(scene) - 1) <= 1e-9);
    CHECK(std::abs(end.x(2, 1) - 0.05 + weight(scene) * compliance / 4) <= 1e-11);  // four contacts
  }
}

TEST_CASE("a ball rolls when it has slid for 2/7 of its speed") {
  BodyScene build({.friction = 0.2});
  build.ground();
  build.ball(0.1, 1, {Vec3(0, 0, 0.1), Eigen::Quaterniond::Identity(), Vec3(1, 0, 0)});
  const State end = run(build.finish(), contact_method("direct"), 0.001, 300);
  CHECK(std::abs(end.v(0, 1) - 5.0 / 7) <= 1e-12);
  CHECK(std::abs(end.spin(1, 1) - 5.0 / 0.7) <= 1e-11);
}

TEST_CASE(
    "friction turns a ball that lands within a step at its lowest point, wherever directions are taken") {
  const double blend = GENERATE(0.0, 0.5, 1.0), radius = 0.1, speed = 3;
  BodyScene build({.friction = 0.1});
  build.ground();
  build.ball(radius, 1, {Vec3(0, 0, radius + 0.05), Eigen::Quaterniond::Identity(), Vec3(speed, 0, -10)});
  Method method = contact_method("direct");
  method.direction_blend = blend;
  const State end = run(build.finish(), method, 0.01, 1);
  const double taken = speed - end.v(0, 1);
  CHECK(taken > 0.3);
  CHECK(std::abs(0.4 * radius * end.spin(1, 1) - taken) <= 1e-10);
}

TEST_CASE("restitution returns the approaching speed, and with the trapezoidal rule all energy") {
  for (const double restitution : {1.0, 0.5}) {
    BodyScene build({.friction = 0, .restitution = restitution});
    build.ground();
    build.ball(0.1, 2, {Vec3(0, 0, 0.6)});
    const Scene scene = build.finish();
    Method method = contact_method("direct");
    method.integrator = "newmark";
    method.alpha = 0.5;
    Workspace workspace(scene, method);
    State state = scene.initial;
    constexpr double h = 0.001;
    const auto energy = [&] { return state.v.col(1).squaredNorm() + 2 * gravity * state.x(2, 1); };
    const double start = energy();
    int bounces = 0;
    for (int k = 0; k < 2000; ++k) {
      const double before = state.v(2, 1);
      REQUIRE(step(workspace, h, state).status == Status::ok);
      const double after = state.v(2, 1);
      if (before < 0 && after > 0 && bounces++ < 3) CHECK(std::abs(after + restitution * before) <= 1e-12);
    }
    CHECK(bounces >= 3);
    if (restitution == 1) CHECK(std::abs(energy() - start) <= 1e-10 * start);
  }
}

TEST_CASE("a box and a ball that tumble on soft ground are solved at every step") {
  BodyScene build({.friction = 0.5, .restitution = 0.5, .compliance = 1e-5});
  build.ground();
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(0.5, Vec3(1, 2, 0.5).normalized()));
  build.box(Vec3(0.3, 0.2, 0.1), 6, {Vec3(0, 0, 0.12), turned, Vec3(0.3, 0, -1), Vec3(3, -4, 2)});
  build.ball(0.1, 4, {.position = {0.02, 0.01, 0.36}, .velocity = {0, 0.2, -1}, .spin = {1, 5, 0}});
  const Scene scene = build.finish();
  for (const auto relaxation : general_solver_names())
    for (const auto law : friction_names) {
      Method method = contact_method(relaxation, law);
      method.tolerance = 1e-8;
      const State end = run(scene, method, 0.005, 100);
      CHECK(end.x.row(2).rightCols(2).minCoeff() > 0);  // neither has fallen through
    }
}

TEST_CASE("an overlap parts no faster than it is told") {
  BodyScene build({.friction = 0.5});
  build.ground();
  build.box(Vec3::Constant(0.2), 1, {Vec3(0, 0, 0.1 - 1e-3)});
  build.contact().recovery = 0.01;
  const Scene scene = build.finish();
  const Method method = contact_method("direct");
  const State end = run(scene, method, 0.01, 5);
  CHECK(std::abs(end.x(2, 1) - (0.1 - 1e-3 + 5 * 0.01 * 0.01)) <= 1e-12);
}

TEST_CASE("a fast body pushes those it has not touched yet within a step") {
  BodyScene build({.friction = 0}, 0);
  constexpr double gap = 1e-3;
  build.ball(0.1, 1, {Vec3(0, 0, 0), Eigen::Quaterniond::Identity(), Vec3(10, 0, 0)});
  build.ball(0.1, 1, {Vec3(0.2 + gap, 0, 0)});
  build.ball(0.1, 1, {Vec3(0.4 + 2 * gap, 0, 0)});
  for (const auto relaxation : general_solver_names()) {
    INFO(relaxation);
    const State end = run(build.finish(), contact_method(relaxation), 0.01, 1);
    CHECK(end.x(0, 1) - end.x(0, 0) >= 0.2 - 1e-10);
    CHECK(end.x(0, 2) - end.x(0, 1) >= 0.2 - 1e-10);
    CHECK(end.v(0, 2) > 0);
    CHECK(std::abs(end.v.row(0).sum() - 10) <= 1e-10);
  }
}

TEST_CASE("nodes rest on bodies and push them") {
  BodyScene build({.friction = 0.5});
  build.ground();
  build.box(Vec3(1, 1, 0.2), 3, {Vec3(0, 0, 0.1)});
  Scene scene = build.finish();
  const int node = add_node(scene, Vec3(0.2, 0.1, 0.2 + 0.01), 2, Vec3(0.5, 0, 0));
  auto& contact = std::get<Contact>(scene.effects.back());
  contact.node = {node};
  contact.radius = {0.01};
  contact.node_material = {0};
  for (const auto relaxation : general_solver_names()) {
    const Method method = contact_method(relaxation);
    Workspace workspace(scene, method);
    const State end = run(scene, method, 0.01, 30, workspace);
    INFO(relaxation);
    CHECK(std::abs(end.x(0, node) - 0.2 - sliding_distance(0.5, 0.5 * gravity, 0.01, 30)) <= 1e-9);
    CHECK(std::abs(end.x(2, node) - 0.21) <= 1e-10);
    CHECK(std::abs(ground_force(workspace).z() / weight(scene) - 1) <= 1e-8);
  }
}
