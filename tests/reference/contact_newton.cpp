// Steps with contact that have a closed form, and agreement of the two cone solvers where there is none.
#include "contact_newton.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "cone_ipopt.h"
#include "judged_contact.h"
#include "mesh.h"
#include "turning_bar.h"

using namespace pbd;
using namespace pbd::reference;
using namespace pbd::test;
using pbdcheck::BodyScene;

namespace {

/// A ball of 1 kg and 0.1 m, 1 cm above the ground.
Scene falling_ball(const ContactLaw& law, const Vec3& velocity, double gap = 0.01) {
  BodyScene scene(law, gravity);
  scene.ground();
  scene.ball(0.1, 1, {.position = {0, 0, 0.1 + gap}, .velocity = velocity});
  return scene.finish();
}

}  // namespace

TEST_CASE("a ball that hits the ground slides by either law as by hand") {
  const double mu = 0.05;
  const Scene scene = falling_ball({.friction = mu}, {1, 0, -3});
  // Its impulse p ends the fall where the gap closes; its bottom slips at 1 - (1 + 5/2) mu p.
  const double p = 2 + gravity * judged_step_s;
  const auto coulomb = judged(scene, Friction::coulomb);
  CHECK(std::abs(coulomb.v(2, 1) + 1) <= by_hand);
  CHECK(std::abs(coulomb.v(0, 1) - (1 - mu * p)) <= by_hand);
  CHECK(std::abs(coulomb.spin(1, 1) - mu * p / 0.04) <= by_hand / 0.1);
  // The convex law opens the gap by mu times the slip.
  const double opened = (p + mu) / (1 + 3.5 * mu * mu);
  const auto convex = judged(scene, Friction::cone);
  CHECK(std::abs(convex.v(2, 1) - (opened - 3 - gravity * judged_step_s)) <= by_hand);
  CHECK(std::abs(convex.v(0, 1) - (1 - mu * opened)) <= by_hand);
}

TEST_CASE("a ball bounces by its restitution, and sinks into what gives way") {
  CHECK(std::abs(judged(falling_ball({.restitution = 0.5}, {0, 0, -3})).v(2, 1) - 1.5) <= by_hand);
  const double compliance = 1e-5;
  const Scene scene = falling_ball({.compliance = compliance}, Vec3::Zero(), 0);
  CHECK(std::abs(judged(scene).v(2, 1) +
                 gravity * judged_step_s / (1 + judged_step_s * judged_step_s / compliance)) <= by_hand);
  // gap + T (gap - 0)/h + A F = 0
  const double time = 0.02;
  const Scene damped = falling_ball({.compliance = compliance, .damping = time}, Vec3::Zero(), 0);
  CHECK(std::abs(judged(damped).v(2, 1) +
                 gravity * judged_step_s / (1 + judged_step_s * (judged_step_s + time) / compliance)) <=
        by_hand);
}

TEST_CASE("what falls past a box meets nothing, whatever its restitution") {
  const double restitution = GENERATE(0.0, 0.5);
  BodyScene build({.friction = 0.3, .restitution = restitution}, gravity);
  build.fixed(Box{Vec3::Ones()}, {.position = {0, 0, -0.5}});
  // 6 mm beside it, from 30 mm above its top to 30 mm below.
  build.box(Vec3::Constant(0.4), 1, {.position = {0.706, 0.05, 0.23}, .velocity = {0, 0, -6}});
  const auto j = judged(build.finish());
  CHECK((j.v.col(1) + (6 + gravity * judged_step_s) * Vec3::UnitZ()).norm() <= by_hand);
  CHECK(j.spin.col(1).norm() <= by_hand);
}

TEST_CASE("a ball that comes down where a face has ended flies on, whatever its restitution") {
  // 1 mm above it and 10 mm from its edge: it is down after 8 ms, 16 mm on, and clears the edge.
  const Vec3 velocity(2, 0, -0.125);
  BodyScene build({.friction = 0, .restitution = 1}, 0);
  build.fixed(Box{Vec3::Ones()}, {.position = {0, 0, -0.5}});
  build.ball(0.1, 1, {.position = {0.49, 0, 0.101}, .velocity = velocity});
  CHECK((judged(build.finish()).v.col(1) - velocity).norm() <= by_hand);
}

TEST_CASE("a corner that only seems to come down where the step begins does not come back") {
  const Scene scene = turning_bar();
  const auto end = judged(scene);
  CHECK(end.v.col(1).norm() <= by_hand);
  CHECK((end.spin - scene.initial.spin).norm() <= by_hand);
}

TEST_CASE("corners that slide down a side are not lifted on to the face above it, however large the scene") {
  BodyScene build({.friction = 0}, gravity);
  build.fixed(Box{Vec3::Ones()}, {.position = {0, 0, -0.5}});
  build.fixed(Box{Vec3::Ones()}, {.position = {0, 20, -0.5}});
  // A plate that moves against the side 0.5 mm away, its lower corners 5 mm below the top.
  const double apart = 5e-4;
  build.box({0.4, 0.4, 0.008}, 1, {.position = {0.7 + apart, 0, -0.001}, .velocity = {-1, 0, -1}});
  CHECK((judged(build.finish()).v.col(2) - Vec3(-apart / judged_step_s, 0, -1 - gravity * judged_step_s))
            .norm() <= by_hand);
}

TEST_CASE("a corner that bounces returns the speed that the spin in the body's own axes gives it") {
  const Vec3 size(0.4, 0.3, 0.2), velocity(-1, 0, -3), spin(1, 5, 2);
  constexpr double restitution = 0.5;
  BodyScene build({.friction = 0, .restitution = restitution}, 0);
  build.ground();
  const Eigen::Quaterniond askew(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
  const Points corners = box_surface(size).x;
  double low = 0;
  for (Eigen::Index i = 0; i < corners.cols(); ++i) low = std::min(low, (askew * Vec3(corners.col(i))).z());
  build.box(size, 1,
            {.position = {0, 0, 5e-3 - low}, .orientation = askew, .velocity = velocity, .spin = spin});
  const auto j = judged(build.finish());
  const Eigen::Quaterniond turned(j.orientation[1]);
  Vec3 arm = Vec3::Zero();
  for (Eigen::Index i = 0; i < corners.cols(); ++i)
    if (const Vec3 own = turned * Vec3(corners.col(i)); own.z() < arm.z()) arm = own;
  const Vec3 before = velocity + (turned * spin).cross(arm),
             after = j.v.col(1) + (turned * Vec3(j.spin.col(1))).cross(arm);
  CHECK(before.z() < -1);
  CHECK(std::abs(after.z() + restitution * before.z()) <= by_hand);
}

TEST_CASE("edges that cross, corners and balls stop each other where their gap closes") {
  const ContactLaw law{.friction = 0.3};
  const auto tilted = [](const Vec3& axis) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 4, axis));
  };
  const double half_diagonal = 0.1 * std::sqrt(2.0), gap = 0.005;
  BodyScene edges(law, 0);
  edges.fixed(Box{Vec3::Constant(0.2)}, {.position = Vec3::Zero(), .orientation = tilted(Vec3::UnitX())});
  edges.box(Vec3::Constant(0.2), 2,
            {.position = {0, 0, 2 * half_diagonal + gap},
             .orientation = tilted(Vec3::UnitY()),
             .velocity = {0, 0, -2}});
  CHECK(std::abs(judged(edges.finish()).v(2, 1) + gap / judged_step_s) <= by_hand);

  BodyScene corner(law, 0);  // of a box under a ball, whose middle is above it
  const Eigen::Quaterniond on_end = Eigen::Quaterniond::FromTwoVectors(Vec3::Ones(), Vec3::UnitZ());
  corner.fixed(Box{Vec3::Constant(0.2)}, {.position = Vec3::Zero(), .orientation = on_end});
  corner.ball(0.05, 1, {.position = {0, 0, 0.1 * std::sqrt(3.0) + 0.05 + gap}, .velocity = {0, 0, -2}});
  CHECK(std::abs(judged(corner.finish()).v(2, 1) + gap / judged_step_s) <= by_hand);

  BodyScene balls(law, 0);  // v_a - v_b = -gap/h and their momentum is kept
  balls.ball(0.1, 1, {.position = {0, 0, 0.2 + gap}, .velocity = {0, 0, -2}});
  balls.ball(0.1, 3, {.position = {0, 0, 0}});
  const auto j = judged(balls.finish());
  CHECK(std::abs(j.v(2, 0) - j.v(2, 1) + gap / judged_step_s) <= by_hand);
  CHECK(std::abs(j.v(2, 0) + 3 * j.v(2, 1) + 2) <= by_hand);
}

TEST_CASE("a half space has no corners where its frame is: what slides over them goes on") {
  BodyScene scene(ContactLaw{.friction = 0}, gravity);
  scene.ground();
  scene.box(Vec3::Constant(0.2), 1, {.position = {0.099, 0.005, 0.1}, .velocity = {0.05, 0.02, 0}});
  const auto j = judged(scene.finish());
  CHECK((Vec3(j.v.col(1)) - Vec3(0.05, 0.02, 0)).norm() <= by_hand);
}

TEST_CASE("a triangle's nodes take up what a ball presses on its middle") {
  BodyScene bodies(ContactLaw{.friction = 0}, 0);
  const double thickness = 0.01, gap = 0.004, mass = 0.2;
  bodies.ball(0.1, 1, {.position = {0, 0, 0.1 + thickness / 2 + gap}, .velocity = {0, 0, -2}});
  Scene scene = bodies.finish();
  std::array<int, 3> nodes{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double angle = 2 * std::numbers::pi / 3 * static_cast<double>(k);
    nodes[k] = add_node(scene, Vec3(std::cos(angle), std::sin(angle), 0), mass);
  }
  for (Effect& effect : scene.effects)
    if (auto* contact = std::get_if<Contact>(&effect)) {
      contact->triangle.push_back(nodes);
      contact->thickness = thickness;
    }
  // p (1/m + 1/(3 M)) = 2 - gap/h, a third of it for each node
  const double p = (2 - gap / judged_step_s) / (1 + 1 / (3 * mass));
  const auto j = judged(scene);
  CHECK(std::abs(j.v(2, 0) - (-2 + p)) <= by_hand);
  for (const int node : nodes) CHECK(std::abs(j.v(2, node) + p / (3 * mass)) <= by_hand);
}

TEST_CASE("the step of a damped constraint is that of its equation") {
  const double mass = 2, compliance = 1e-4, time = 0.03, stretched = 0.1;
  Scene scene;
  add_node(scene, Vec3(stretched, 0, 0), mass);
  scene.effects.emplace_back(
      Anchor{.node = {0}, .target = {Vec3::Zero()}, .compliance = {compliance}, .damping = {time}});
  const double v =
      -judged_step_s * stretched / compliance / (mass + judged_step_s * (judged_step_s + time) / compliance);
  CHECK(std::abs(judged(scene).v(0, 0) - v) <= by_hand * std::abs(v));
}

TEST_CASE("forces of a soft block on the ground balance its momentum, and nothing is below") {
  BodyScene bodies(ContactLaw{.friction = 0.4}, gravity);
  bodies.ground();
  Scene scene = bodies.finish();
  const int first =
      pbdcheck::add_touching_solid(scene, kuhn_grid({2, 2, 1}, Vec3(0.2, 0.2, 0.1), Vec3(0, 0, 0.006)), 500,
                                   {1e5, 0.3}, Strain::corotational);
  double mass = 0;
  for (int i = first; i < scene.nodes(); ++i) {
    scene.initial.v.col(i) = Vec3(0.5, 0.1, -1);
    mass += scene.mass[static_cast<std::size_t>(i)];
  }
  const auto j = judged(scene);
  Vec3 force = Vec3::Zero(), gained = Vec3::Zero();
  for (const JudgedContact& contact : j.all) force.z() += contact.force[0];
  for (int i = first; i < scene.nodes(); ++i)
    gained += scene.mass[static_cast<std::size_t>(i)] * (j.v.col(i) - scene.initial.v.col(i));
  CHECK(j.contacts >= 9);
  CHECK(std::abs(gained.z() - judged_step_s * (force.z() - mass * gravity)) <= by_hand * mass);
  CHECK(j.x.rightCols(scene.nodes() - first).row(2).minCoeff() >= 0.0005 - 1e-12);  // half of 1 mm
}

TEST_CASE("what collides does not yield") {
  for (const double compliance : {1e-6, 1e-2})
    for (const double restitution : {0.5, 1.0}) {
      BodyScene build({.friction = 0, .restitution = restitution, .compliance = compliance}, 0);
      build.ground();
      build.ball(0.1, 1, {.position = {0, 0, 0.1 + judged_step_s / 2}, .velocity = {0, 0, -1}});
      CHECK(std::abs(judged(build.finish()).v(2, 1) - restitution) <= by_hand);
    }
}

TEST_CASE("no end is ok where what yields is deeper than the judge knows features of it") {
  constexpr double radius = 0.1, mass = 1;
  const auto on_box = [](double depth) {  // of what lies on it
    BodyScene build({.friction = 0, .compliance = depth / (mass * gravity)}, gravity);
    build.box({1, 1, 0.5}, infinity, {.position = {0, 0, -0.25}});
    return build;
  };
  const auto ends = [](const Scene& scene) {
    return contact_newton(scene, scene.initial, judged_step_s, Friction::coulomb, cone_interior_point);
  };
  const auto pressed = [&](double depth) {
    BodyScene build = on_box(depth);
    build.ball(radius, mass, {.position = {0, 0, radius - depth}});
    return build.finish();
  };
  const auto shallow = judged(pressed(0.1 * radius));
  CHECK(shallow.contacts == 1);
  CHECK(shallow.v.col(1).norm() <= by_hand);
  for (const double part : {0.3, 0.9, 1.2}) {
    const auto j = ends(pressed(part * radius));
    CHECK((j.outcome != Outcome::ok || j.v.col(1).norm() <= by_hand));
  }
  // On a fixed capsule, of which one end is deep and the other one's features do not touch.
  constexpr double deep = 0.04, apart = 5e-4, round = 0.05, length = 0.4;
  BodyScene build({.friction = 0, .compliance = deep / (mass * gravity)}, gravity);
  const double tilt = std::asin((deep + apart) / length);
  build.fixed(
      Capsule{round, length},
      {.position = {0, 0, (deep - apart) / 2 - round},
       .orientation = Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2 + tilt, Vec3::UnitY()))});
  build.box({1, 1, 0.5}, mass, {.position = {0, 0, 0.25}});
  const auto j = ends(build.finish());
  CHECK((j.outcome != Outcome::ok || j.v(2, 1) > -0.5 * gravity * judged_step_s));
}

TEST_CASE("both cone solvers find the same step, from the state or from what the other claims") {
  BodyScene boxes(ContactLaw{.friction = 0.4}, gravity);
  boxes.ground();
  const Eigen::Quaterniond askew(Eigen::AngleAxisd(0.3, Vec3(1, 2, 0.5).normalized()));
  boxes.box({0.2, 0.2, 0.1}, 4, {.position = {0, 0, 0.05}});
  boxes.box({0.1, 0.1, 0.1}, 1,
            {.position = {0.02, 0.01, 0.19}, .orientation = askew, .velocity = {0.2, 0, -2}});
  const Scene scene = boxes.finish();
  const auto one = judged(scene), other = judged(scene, Friction::coulomb, cone_ipopt);
  CHECK(one.contacts >= 3);
  CHECK((one.v - other.v).norm() <= 1e-6);
  const StepClaim claim{.scene = scene,
                        .start = scene.initial,
                        .end = {judged_step_s, other.x, other.v, other.orientation, other.spin},
                        .h = judged_step_s};
  const auto near =
      contact_newton(scene, scene.initial, judged_step_s, Friction::coulomb, cone_interior_point, {&claim});
  CHECK(near.outcome == Outcome::ok);
  CHECK((near.v - one.v).norm() <= 1e-9);
}

TEST_CASE("no end is ok with boxes in each other that came past each other's edges") {
  int ok = 0;
  for (const auto& [held, speed] : {std::pair{false, 1.0}, {true, 1.0}, {true, 0.2}}) {
    BodyScene boxes(ContactLaw{.friction = 0}, gravity);
    const Vec3 size = Vec3::Constant(0.2);
    if (held)
      boxes.fixed(Box{size}, {.position = Vec3::Zero()});
    else
      boxes.box(size, 4, {.position = Vec3::Zero()});
    const Eigen::Quaterniond askew(Eigen::AngleAxisd(0.01, Vec3(0.2, 0.3, 1).normalized()));
    boxes.box(
        size, 4,
        {.position = {0.205, 0.01, 0.205}, .orientation = askew, .velocity = speed * Vec3(-1.5, 0.05, -1.4)});
    const Scene scene = boxes.finish();
    const auto j =
        contact_newton(scene, scene.initial, judged_step_s, Friction::coulomb, cone_interior_point);
    // Their axes are the world's but for what turns a corner by some millimetres.
    const double deep = 0.2 - (j.x.col(1) - j.x.col(0)).cwiseAbs().maxCoeff();
    ok += j.outcome == Outcome::ok;
    if (j.outcome == Outcome::ok) CHECK(deep <= 0.003);
    if (j.outcome != Outcome::ok) CHECK_FALSE(j.reason.empty());
  }
  CHECK(ok > 0);  // else nothing has been seen
}

TEST_CASE("the judge of contact refuses what it does not know") {
  CHECK_THROWS_WITH(judged(falling_ball({}, Vec3::Zero()), Friction::box), Catch::Contains("coulomb, cone"));
}
