// What a step's ok and its miss are measured by.
#include "step/levels.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "scenes.h"
#include "step/integrators.h"
#include "step/step.h"

using namespace pbd;
using namespace pbd::test;

TEST_CASE("the rounding of a link far away does not excuse one at the origin") {
  constexpr double h = 0.01, far = 1e8;  // s, m
  Scene scene = pbdcheck::chain(5);
  const int node = add_node(scene, Vec3(far, 0, 0), 1);
  add_node(scene, Vec3(far + 1, 0, 0), 1);
  scene.effects.emplace_back(Distance{.node = {{node, node + 1}}, .rest_length = {1}, .compliance = {0}});
  Method method;
  method.relaxation = "gauss_seidel";
  method.outer = "plain";
  method.max_sweeps = 3;
  Workspace workspace(scene, method);
  State state = scene.initial;
  const Report report = step(workspace, h, state);
  REQUIRE(report.status == Status::ok);
  double missed = 0;
  for (int k = 0; k < 5; ++k)
    missed = std::max(missed, std::abs((state.x.col(k + 1) - state.x.col(k)).norm() - 0.2));
  // r^2/N <= (tolerance scale)^2, N <= 2/m of 0.1 kg
  CHECK(missed <= h * method.tolerance * report.scale * std::sqrt(2 / 0.1));
}

TEST_CASE("ground that carries far from its centre excuses no miss") {
  // A cylinder of 100 km tumbles over the ground: lengths are known to 1e-11 m, not to 1e5 times that.
  constexpr double size = 1e5, h = 3;  // m, s
  Scene scene;
  const int ground = add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
  const int body = add_body(scene, Vec3(0, 0, 3 * size), 1, size * size * Vec3(7.0 / 12, 7.0 / 12, 0.5),
                            Eigen::Quaterniond(Eigen::AngleAxisd(0.6, Vec3(3, 1, 0).normalized())));
  Contact contact;
  contact.collider = {{HalfSpace{}, ground}, {Cylinder{size, 2 * size}, body}};
  scene.effects = {Gravity{}, contact};
  Workspace workspace(scene, {});
  State state = scene.initial;
  int solved = 0;
  for (int k = 0; k < 150; ++k) {
    const Report report = step(workspace, h, state);
    if (report.status != Status::ok) continue;
    ++solved;
    CHECK(report.dual <= workspace.method().tolerance * report.scale);
  }
  CHECK(solved > 100);
}

TEST_CASE("a step that misses tells the constraint that misses most") {
  Scene scene;
  for (const double x : {0.0, 1.0, 2.0}) add_node(scene, Vec3(x, 0, 0), x == 1 ? 1 : infinity);
  Distance links{.node = {{0, 1}, {1, 2}}, .rest_length = {1, 0.4}, .compliance = {1e-3, 0}};
  links.node.push_back({0, 1});  // 0.4 m and 0.9 m do not reach over 2 m: 0.7 m are missing
  links.rest_length.push_back(0.9);
  links.compliance.push_back(0);
  scene.effects = {Gravity{}, links};
  State state = scene.initial;
  Workspace workspace(scene, {});
  const Report report = step(workspace, 0.01, state);
  REQUIRE(report.status != Status::ok);
  REQUIRE(report.worst.has_value());
  CHECK(report.worst->effect == 1);
  CHECK(report.worst->constraint != 0);
  scene.effects = {Gravity{}};
  state = scene.initial;
  Workspace free(scene, {});
  CHECK_FALSE(step(free, 0.01, state).worst.has_value());
}

TEST_CASE("a step is not ok where a body turns so far that its angle is lost") {
  constexpr double h = 0.01;  // s
  for (const double share : {0.9, 1.1}) {
    Scene scene;
    add_body(scene, Vec3::Zero(), 1, Vec3::Ones(), Eigen::Quaterniond::Identity(), Vec3::Zero(),
             Vec3(0, 0, share * most_turn / h));
    State state = scene.initial;
    Workspace workspace(scene, {});
    const Report report = step(workspace, h, state);
    CHECK(report.status == (share < 1 ? Status::ok : Status::diverged));
    CHECK((state.time > 0) == (share < 1));
  }
}

TEST_CASE("heavy bodies far away that rest do not excuse a light one that a force moves") {
  constexpr double force = 1e-4, h = 1e-3;  // N, s
  for (const Integrator& integrator : integrators()) {
    Scene scene;
    const int a = add_body(scene, Vec3(1000, 0, 0), 1e4, Vec3::Constant(1e5)),
              b = add_body(scene, Vec3(1020, 0, 0), 1e4, Vec3::Constant(1e5)),
              light = add_body(scene, Vec3::Zero(), 1, Vec3::Ones());
    scene.effects.emplace_back(PointJoint{{{a, b}}, {{Vec3(10, 0.3, 0.1), Vec3(-10, 0.3, 0.1)}}, {0}});
    scene.effects.emplace_back(ExternalForce{{light}, {Vec3(force, 0, 0)}});
    Method method;
    method.integrator = integrator.name;
    Workspace workspace(scene, method);
    State state = scene.initial;
    for (int k = 0; k < 20; ++k) {
      INFO(integrator.name << ", step " << k);
      CHECK(step(workspace, h, state).status == Status::ok);
      CHECK(std::abs(state.v(0, light) - force * state.time) <= 1e-6 * force * state.time);
    }
  }
}
