// What takes part in contact: all that meets within a step, by turning, falling or coming both ways, and
// nothing that only passes.
#include <numbers>

#include "contact_runs.h"
#include "mesh.h"
#include "scenes/contacts.h"
#include "turning_bar.h"

using namespace pbd;
using namespace pbd::test;
using pbdcheck::BodyScene;

TEST_CASE("what turns in place meets what only its turning reaches") {
  // A plank of 1 m turns by 0.1 rad in the step: its end goes 45 mm sideways, to a ball 10 mm beside it.
  constexpr double h = 0.05, half_width = 0.05, radius = 0.05;
  BodyScene build({.friction = 0}, 0);
  build.box({1, 2 * half_width, 0.1}, 1, {.position = {0, 0, 0}, .spin = {0, 0, 2}});
  build.ball(radius, 1, {.position = {0.45, half_width + radius + 0.01, 0}});
  const State end = run(build.finish(), contact_method("direct"), h, 1);
  const Vec3 own = end.orientation[0].conjugate() * Vec3(end.x.col(1) - end.x.col(0));
  CHECK(end.v(1, 1) > 0);
  CHECK(own.y() >= half_width + radius - 1e-9);
}

TEST_CASE("a node that falls far within a step is stopped at the ground") {
  constexpr double radius = 0.01, h = 0.01;
  BodyScene build({.friction = 0}, 0);
  build.ground();
  Scene scene = build.finish();
  const int node = add_node(scene, Vec3(0, 0, 0.5), 1, Vec3(0, 0, -100));  // 1 m a step
  auto& contact = std::get<Contact>(scene.effects.back());
  contact.node = {node};
  contact.radius = {radius};
  contact.node_material = {0};
  const State end = run(scene, contact_method("direct"), h, 1);
  CHECK(std::abs(end.x(2, node) - radius) <= 1e-9);
}

TEST_CASE("a ground that rises or tilts within a step meets what is far above it") {
  // Its plane comes 1 m higher, or 0.3 rad of turning lift it by 0.9 m where the ball is.
  constexpr double radius = 0.05, h = 0.01, side = 3;
  const bool tilts = GENERATE(false, true);
  BodyScene build({.friction = 0}, 0);
  const int ground = build.ground();
  const int ball = build.ball(radius, 1, {.position = {side, 0, 0.5}});
  Scene scene = build.finish();
  const int node = scene.bodies[static_cast<std::size_t>(ground)].node;
  if (tilts)
    scene.initial.spin.col(ground) = Vec3(0, -0.3 / h, 0);
  else
    scene.initial.v.col(node) = Vec3(0, 0, 1 / h);
  const State end = run(scene, contact_method("direct"), h, 1);
  const Vec3 normal = end.orientation[static_cast<std::size_t>(ground)] * Vec3::UnitZ();
  const Vec3 apart = end.x.col(scene.bodies[static_cast<std::size_t>(ball)].node) - end.x.col(node);
  CHECK(std::abs(normal.dot(apart) - radius) <= 1e-9);
}

TEST_CASE("what passes within reach and meets nothing is not thrown back") {
  // A ball flies 0.1 m a step along a slope, 20 mm above it, and comes down by 1 mm of them; the box about
  // its course is cut by the slope.
  const double slope = std::numbers::pi / 4;
  const Vec3 normal(std::sin(slope), 0, std::cos(slope)), along(std::cos(slope), 0, -std::sin(slope));
  const Vec3 velocity = 10 * along - 0.1 * normal;
  BodyScene build({.friction = 0, .restitution = 0.5}, 0);
  build.ground(slope);
  build.ball(0.1, 1, {.position = 0.12 * normal, .velocity = velocity});
  const Scene scene = build.finish();
  Workspace workspace(scene, contact_method("direct"));
  const State end = run(scene, contact_method("direct"), 0.01, 1, workspace);
  CHECK(workspace.contacts().size() == 1);  // it is within reach
  CHECK((end.v.col(1) - velocity).norm() <= 1e-12 * velocity.norm());
}

TEST_CASE("corners that turn above the ground do not come back from it") {
  const Scene scene = turning_bar();
  Workspace workspace(scene, contact_method("direct"));
  const State end = run(scene, contact_method("direct"), 0.01, 2, workspace);
  CHECK(!workspace.contacts().empty());  // they are within reach
  CHECK(end.v.col(1).norm() <= 1e-12);
  CHECK((end.spin - scene.initial.spin).norm() <= 1e-12 * scene.initial.spin.norm());
}

TEST_CASE("what flies by has no rows") {
  // A ball flies 0.1 m a step along the ground, 80 mm above it, and comes down by 1 mm of them.
  BodyScene build({.friction = 0.3}, 0);
  build.ground();
  build.ball(0.1, 1, {.position = {0, 0, 0.18}, .velocity = {10, 0, -0.1}});
  const Scene scene = build.finish();
  Workspace workspace(scene, contact_method("direct"));
  run(scene, contact_method("direct"), 0.01, 1, workspace);
  CHECK(workspace.contacts().empty());
}

TEST_CASE("what flies side by side is not near for its speed, and meets where one of it is stopped") {
  constexpr double h = 0.01, size = 0.2, apart = 0.06, speed = 10;  // half its size a step
  BodyScene build({.friction = 0.3}, 0);
  const double height = GENERATE(5.0, 0.005);  // m, above the ground: nothing is stopped, or all
  build.ground();
  for (int k = 0; k < 3; ++k)
    build.box(Vec3::Constant(size), 1,
              {.position = {0, 0, height + size / 2 + k * (size + apart)}, .velocity = {0, 0, -speed}});
  const Scene scene = build.finish();
  const Method method = contact_method("direct");
  Workspace workspace(scene, method);
  const State end = run(scene, method, h, 1, workspace);
  const bool stopped = height < speed * h;
  CHECK(workspace.contacts().empty() == !stopped);
  for (int k = 0; k < 3; ++k) {
    const double free = height + size / 2 + k * (size + apart) - speed * h;
    CHECK(std::abs(end.x(2, 1 + k) - (stopped ? std::max(free, (0.5 + k) * size) : free)) <= 1e-9);
  }
}

TEST_CASE("what is struck within a step meets the ground that it rested above") {
  constexpr double h = 0.01, radius = 0.1, above = 0.03, apart = 0.005;
  BodyScene build({.friction = 0}, 0);
  build.ground();
  build.ball(radius, 1, {.position = {0, 0, above + radius}});
  build.ball(radius, 1, {.position = {0, 0, above + apart + 3 * radius}, .velocity = {0, 0, -10}});
  const State end = run(build.finish(), contact_method("direct"), h, 1);
  for (int k = 0; k < 2; ++k) CHECK(std::abs(end.x(2, 1 + k) - (1 + 2 * k) * radius) <= 1e-9);
}

TEST_CASE("sheets that approach each other do not pass through each other") {
  // A triangle that stands on its corner and a level one, 50 mm apart, each of which comes 30 mm a step.
  constexpr double thickness = 2e-3, apart = 0.05, speed = 3, h = 0.01;
  Scene scene;
  Contact contact;
  Distance links;
  const auto triangle = [&](const Eigen::Matrix3d& x, double up) {
    const int first = scene.nodes();
    for (int k = 0; k < 3; ++k) add_node(scene, x.col(k), 1, Vec3(0, 0, up));
    contact.triangle.push_back({first, first + 1, first + 2});
    for (const auto& [a, b] : {std::array{0, 1}, std::array{1, 2}, std::array{0, 2}}) {
      links.node.push_back({first + a, first + b});
      links.rest_length.push_back((x.col(a) - x.col(b)).norm());
      links.compliance.push_back(0);
    }
  };
  Eigen::Matrix3d level, standing;
  level << -1, 1, 0, -1, -1, 1, 0, 0, 0;
  standing << 0, 0.1, 0, 0, 0, 0.1, thickness + apart, 1, 1;
  triangle(level, speed);
  triangle(standing, -speed);
  contact.thickness = thickness;
  contact.law[0].friction = 0;
  scene.effects = {links, contact};
  const State end = run(scene, contact_method("direct"), h, 1);
  const Vec3 a = end.x.col(0), b = end.x.col(1), c = end.x.col(2);
  const double gap = (b - a).cross(c - a).normalized().dot(Vec3(end.x.col(3)) - a);
  CHECK(gap >= thickness - 1e-9);
}

TEST_CASE("balls and nodes that are thrown twenty of their sizes a step at each other stop where they meet") {
  // The gap g closes in the step, v_a - v_b = g/h, and momentum stays: v_a + v_b = v for equal masses.
  constexpr double radius = 0.1, gap = 1.3, h = 0.01, speed = 400;
  for (const bool node : {false, true}) {
    BodyScene build({.friction = 0}, 0);
    build.ball(radius, 1, {.position = {0, 0, 0}});
    const Vec3 from(-gap - 2 * radius, 0, 0), velocity(speed, 0, 0);
    if (!node) build.ball(radius, 1, {.position = from, .velocity = velocity});
    Scene scene = build.finish();
    auto& contact = std::get<Contact>(scene.effects.back());
    contact.continuous = true;
    if (node) {
      contact.node = {add_node(scene, from, 1, velocity)};
      contact.radius = {radius};
      contact.node_material = {0};
    }
    State state = scene.initial;
    Workspace workspace(scene, contact_method("direct"));
    CHECK(step(workspace, h, state).status == Status::ok);
    CHECK(std::abs(state.v(0, 1) - (speed + gap / h) / 2) <= 1e-6 * speed);
    CHECK(std::abs(state.v(0, 0) - (speed - gap / h) / 2) <= 1e-6 * speed);
  }
}

TEST_CASE("a missed step leads through nothing that it begins apart from, where ways are looked at") {
  constexpr double h = 0.01, thickness = 0.02;
  const double speed = GENERATE(40.0, 1000.0);  // two and fifty sizes a step
  for (const bool continuous : {false, true}) {
    INFO(speed << " m/s, continuous: " << continuous);
    BodyScene build({.friction = 0.5}, 0);
    build.fixed(Box{{thickness / 2, 1, 1}}, {.position = {0, 0, 0}});
    const int ball = build.ball(0.1, 1, {.position = {-0.2, 0.03, 0.02}, .velocity = {speed, 1, 2}});
    const int follower =
        build.box({0.2, 0.2, 0.2}, 2, {.position = {-0.5, 0, 0}, .velocity = {2 * speed, 0, 0}});
    Scene scene = build.finish();
    std::get<Contact>(scene.effects.back()).continuous = continuous;
    Method method;
    method.outer = "proximal";
    method.tolerance = 0;  // never met
    method.max_outer = 1;
    method.max_sweeps = 1;
    State state = scene.initial;
    Workspace workspace(scene, method);
    CHECK(step(workspace, h, state).status == Status::not_converged);
    for (int k = 0; k < 2; ++k) step(workspace, h, state);
    const bool behind = state.x(0, ball) > 0 || state.x(0, follower) > state.x(0, ball);
    CHECK(behind == !continuous);
  }
}

TEST_CASE("balls that touch as the step begins do not pass through each other where ways are looked at") {
  // Equal masses without restitution go on together: half the speed each.
  constexpr double radius = 0.05, h = 0.01;
  const double speed = GENERATE(20.0, 100.0, 900.0);  // two to ninety sizes a step
  INFO(speed << " m/s");
  BodyScene build({.friction = 0}, 0);
  build.ball(radius, 1, {.position = {0, 0, 0}});
  build.ball(radius, 1, {.position = {-2 * radius, 0, 0}, .velocity = {speed, 0, 0}});
  Scene scene = build.finish();
  std::get<Contact>(scene.effects.back()).continuous = true;
  State state = scene.initial;
  Workspace workspace(scene, contact_method("direct"));
  CHECK(step(workspace, h, state).status == Status::ok);
  CHECK(std::abs(state.v(0, 0) - speed / 2) <= 1e-6 * speed);
  CHECK(std::abs(state.v(0, 1) - speed / 2) <= 1e-6 * speed);
}

TEST_CASE("a ball that leaves another one along their plane is not held") {
  constexpr double radius = 0.05, h = 0.01, speed = 300;
  BodyScene build({.friction = 0}, 0);
  build.ball(radius, 1, {.position = {0, 0, 0}});
  build.ball(radius, 1, {.position = {-2 * radius, 0, 0}, .velocity = {0, speed, 0}});
  Scene scene = build.finish();
  std::get<Contact>(scene.effects.back()).continuous = true;
  State state = scene.initial;
  Workspace workspace(scene, contact_method("direct"));
  CHECK(step(workspace, h, state).status == Status::ok);
  CHECK(std::abs(state.v(1, 1) - speed) <= 1e-6 * speed);
}
