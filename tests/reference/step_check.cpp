// A true step, made by hand, is not refuted; with one number of it changed it is, by the check of that law.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "claimed_contacts.h"

using namespace pbd;
using namespace pbd::test;

namespace {

constexpr double h = Step::h, g = weight_per_kg;

Step free_fall() {
  Scene scene;
  add_node(scene, Vec3(0, 0, 1), 2, Vec3(1, 0, 0));
  scene.effects.emplace_back(Gravity{});
  Step step(scene);
  step.end.v.col(0).z() -= h * g;
  step.move();
  return step;
}

/// A ball of 1 kg that falls on the ground at 1 m/s and leaves it at `after`, pressed as that takes; above 0
/// m/s another falls freely beside it.
Step bounce(double restitution, double after, double beside = 0) {
  pbdcheck::BodyScene scene(ContactLaw{.friction = 0, .restitution = restitution}, g);
  scene.ground();
  scene.ball(0.1, 1, {.position = {0, 0, 0.105}, .velocity = {0, 0, -1}});
  if (beside > 0) scene.ball(0.1, 1, {.position = {1, 0, 50}, .velocity = {0, 0, -beside}});
  Step step(scene.finish());
  step.end.v.col(1).z() = after;
  if (beside > 0) step.end.v.col(2).z() -= h * g;
  step.move();
  step.contacts.push_back({.collider = {1, 0},
                           .point = step.end.x.col(1) - Vec3(0, 0, 0.1),
                           .normal = Vec3::UnitZ(),
                           .force = {0, 0, (after + 1) / h + g},
                           .gap = step.end.x(2, 1) - 0.1});
  return step;
}

/// A ball of 0.1 kg that leaves the ground at 3 m/s meets one of 10 kg, which leaves at `after`: the small
/// one stays between them.
Step pinned(double restitution, double after) {
  pbdcheck::BodyScene scene(ContactLaw{.friction = 0, .restitution = restitution}, 0);
  scene.ground();
  scene.ball(0.1, 0.1, {.position = {0, 0, 0.1}, .velocity = {0, 0, 3}});
  scene.ball(0.1, 10, {.position = {0, 0, 0.305}});
  Step step(scene.finish());
  step.end.v.col(1).z() = 0;
  step.end.v.col(2).z() = after;
  step.move();
  const double upper = 10 * after / h;
  step.contacts.push_back({.collider = {1, 0},
                           .point = Vec3::Zero(),
                           .normal = Vec3::UnitZ(),
                           .force = {0, 0, upper - 0.1 * 3 / h},
                           .gap = 0});
  step.contacts.push_back({.collider = {2, 1},
                           .point = Vec3(0, 0, 0.2),
                           .normal = Vec3::UnitZ(),
                           .force = {0, 0, upper},
                           .gap = 0.005 + h * after});
  return step;
}

/// A node of 1 kg in the corner of the ground and a smooth wall, which turns its slip of 1 m/s on the ground
/// round. By the convex law it leaves the ground by c + mu, c = 1 m/s what it comes at, and `more`.
Step turned_round(double friction, double more) {
  pbdcheck::BodyScene build(ContactLaw{}, 0);
  build.materials(2, {.friction = 0, .restitution = 1});
  build.law(0, 0, {.friction = friction, .restitution = 1});
  build.ground();
  build.ground(std::numbers::pi / 2, 1);
  build.contact().node = {2};
  build.contact().radius = {0.1};
  build.contact().node_material = {0};
  Scene scene = build.finish();
  add_node(scene, Vec3(0.1, 0, 0.1), 1, Vec3(-1, 0, -1));
  Step step(scene);
  step.friction = Friction::cone;
  const double up = 2 + friction + more;  // N s
  step.end.v.col(2) = Vec3(1, 0, up - 1);
  step.move();
  step.contacts.push_back({.collider = {2, 0},
                           .point = Vec3(0.1, 0, 0),
                           .normal = Vec3::UnitZ(),
                           .force = Vec3(-friction * up, 0, up) / h,
                           .gap = h * (up - 1)});
  step.contacts.push_back({.collider = {2, 1},
                           .point = Vec3(0, 0, 0.1),
                           .normal = Vec3::UnitX(),
                           .force = Vec3(2 + friction * up, 0, 0) / h,
                           .gap = h});
  return step;
}

/// A mass of 2 kg that leaves its place on a spring of 50 N/m at 1 m/s, damped by T = 1 s, or driven by -1 s:
/// 2 (v1 - v0) = h gamma, gamma = -50 (h v1 + T v1).
Step damped_spring(double retardation) {
  Scene scene;
  add_node(scene, Vec3::Zero(), infinity);
  add_node(scene, Vec3(1, 0, 0), 2, Vec3(1, 0, 0));
  scene.effects.emplace_back(
      Distance{.node = {{0, 1}}, .rest_length = {1}, .compliance = {1.0 / 50}, .damping = {1}});
  Step step(scene);
  const double after = 2 / (2 + h * 50 * (h + retardation));
  step.end.v.col(1).x() = after;
  step.move();
  step.forces[0] = {-50 * (h + retardation) * after};
  return step;
}

}  // namespace

TEST_CASE("a true step is not refuted") {
  CHECK(refuted(free_fall()).empty());
  CHECK(refuted(box_on_ground(0.5, 0)).empty());
  CHECK(refuted(box_on_ground(0.5, 1)).empty());
  CHECK(refuted(balls()).empty());
  CHECK(refuted(swinging_link()).empty());
  CHECK(free_fall().judge().compared >= 4);
}

TEST_CASE("motion: positions follow the velocities, what is fixed stays") {
  Step step = free_fall();
  step.end.x(0, 0) += 1e-9;
  CHECK(refuted(step) == Names{"motion"});
  Step held = swinging_link();
  held.end.v(1, 0) = 1e-9;
  CHECK(refuted(held) == Names{"motion"});
  Step lost = free_fall();
  lost.end.v(0, 0) = std::nan("");
  CHECK_FALSE(refuted(lost).empty());
  for (const auto* integrator : {"newmark", "bdf2", "generalised_alpha", "midpoint"}) {
    INFO(integrator);
    Step other = swinging_link();
    other.integrator = integrator;
    CHECK(refuted(other).empty());
    Step pushed = other, left = other;
    pushed.end.v(1, 0) = 1e-9;
    CHECK(refuted(pushed) == Names{"motion"});
    left.end.x(1, 0) = 1e-9;  // without a velocity
    CHECK(refuted(left).count("motion") == 1);
  }
}

TEST_CASE("momentum: speed from nowhere, a force that is another, a spin that nothing gives") {
  Step step = free_fall();
  step.end.v.col(0) *= 1 + 1e-6;  // energy
  step.move();
  CHECK(refuted(step) == Names{"momentum"});

  Step box = box_on_ground(0.5, 0);
  box.contacts[0].force *= 1.01;
  CHECK(refuted(box) == Names{"angular momentum", "momentum"});

  Step spun = balls();
  spun.end.spin.col(1) = Vec3(0, 0, 1e-4);
  spun.move();
  CHECK(refuted(spun) == Names{"angular momentum"});

  Step link = swinging_link();
  link.forces[1][0] *= 1.01;
  CHECK(refuted(link) == Names{"momentum"});
  link.forces[1].clear();
  CHECK(refuted(link).count("momentum") == 1);
}

TEST_CASE("the scale that is told does not loosen a bound") {
  Step step = free_fall();
  step.end.v.col(0) *= 1 + 1e-6;
  step.move();
  step.scale = 1e9;
  CHECK(refuted(step) == Names{"momentum"});
}

TEST_CASE("rebound and energy: collisions end at their speed, and no damping gives energy") {
  for (const double restitution : {0.5, 1.0}) {
    CHECK(refuted(bounce(restitution, restitution)).empty());
    CHECK(refuted(bounce(restitution, restitution - 1e-6)) == Names{"rebound"});
    CHECK(refuted(bounce(restitution, 1.1)) == Names{"energy", "rebound"});  // 0.105 J
    Step stopped = bounce(restitution, restitution - 1e-6);
    std::get<Contact>(stopped.scene.effects.back()).law[0].compliance = 1e-4;  // a spring holds nothing there
    CHECK(refuted(stopped) == Names{"rebound"});
  }
  // Gravity may be allowed h g (v1 - v0)/2 alone, which is what it gives a ball that keeps its speed.
  CHECK(refuted(bounce(1, 1 + 1e-6)) == Names{"energy", "rebound"});
  CHECK(refuted(bounce(1, 1, 100)).empty());  // another ball falls far beside it
  CHECK(refuted(bounce(1, 1.1, 100)) == Names{"energy", "rebound"});
  // Newton's law lets the large ball leave by 1.5 m/s, which brings it 11.25 J, with 0.45 J where they begin.
  CHECK(refuted(pinned(0.5, 1.5)).empty());
  CHECK(refuted(pinned(0.5, 1.6)) == Names{"rebound"});
  // That the slip is turned round brings mu (c + mu/2), all that the convex law may.
  CHECK(refuted(turned_round(0.5, 0)).empty());
  CHECK(refuted(turned_round(0.5, 1e-4)) == Names{"energy", "rebound"});
  CHECK(refuted(damped_spring(1)).empty());
  CHECK(refuted(damped_spring(-1)) == Names{"energy"});
}

TEST_CASE("constraints: a link is as long as it is to be") {
  Step step = swinging_link();
  step.end.v(0, 1) += 1e-6;  // a length of 1e-8 m a step
  step.move();
  CHECK(refuted(step).count("constraints") == 1);
}

TEST_CASE("constraints: at rest an angle is known to rounding") {
  Scene scene;
  add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
  add_body(scene, Vec3::Zero(), 1, Vec3::Constant(0.1));
  for (const auto& [off, names] : {std::pair{3e-15, Names{}}, {1e-10, Names{"constraints"}}}) {
    Scene held = scene;
    held.effects.emplace_back(
        AngleJoint{{{0, 1}}, {Vec3::UnitY()}, {{Vec3::UnitX(), Vec3::UnitX()}}, {off}, {0}, {0}});
    Step step(held);
    step.forces[0] = {0};
    CHECK(refuted(step) == names);
  }
}

// I (w1 - w0)/h = -c1/A with c1 = c0 + h w1, past half a turn.
TEST_CASE("constraints: within a step an angle goes on past half a turn") {
  constexpr double inertia = 0.1, compliance = 1, w0 = 5, c0 = std::numbers::pi - 0.02, h = Step::h;
  for (const auto& [turns, names] : {std::pair{0, Names{}}, {1, Names{"constraints"}}}) {
    const double jump = 2 * std::numbers::pi * turns, soft = h / (inertia * compliance);
    const double w1 = (w0 - soft * (c0 - jump)) / (1 + soft * h), c1 = c0 - jump + h * w1;
    REQUIRE(c1 + jump > std::numbers::pi);
    Scene scene;
    add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
    add_body(scene, Vec3::Zero(), 1, Vec3::Constant(inertia), Eigen::Quaterniond::Identity(), Vec3::Zero(),
             w0 * Vec3::UnitY());
    scene.effects.emplace_back(
        AngleJoint{{{0, 1}}, {Vec3::UnitY()}, {{Vec3::UnitX(), Vec3::UnitX()}}, {-c0}, {0}, {compliance}});
    Step step(scene);
    step.end.spin.col(1) = w1 * Vec3::UnitY();
    step.move();
    step.forces[0] = {-c1 / compliance};
    INFO(turns << " turns off");
    CHECK(refuted(step) == names);
  }
}

TEST_CASE("momentum: what free surfaces and bodies exchange adds up") {
  Scene scene;
  add_body(scene, Vec3(0.1, 0.1, 0.2), 2, Vec3::Constant(0.01));
  Contact contact;
  contact.collider.push_back({Sphere{0.1}, 0});
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}) add_node(scene, x, 1);
  contact.triangle.push_back({1, 2, 3});
  scene.effects.emplace_back(contact);
  Step step(scene);
  const Vec3 force(0, 0, 3);
  step.contacts.push_back({{0, 2}, Vec3(0.1, 0.1, 0), Vec3::UnitZ(), force, 0});
  step.end.v.col(0) = Step::h * force / 2;
  step.end.v.col(1) = -Step::h * force;  // the shares of its nodes are not told
  step.move();
  CHECK(refuted(step).count("momentum") == 0);
  step.end.v.col(1) *= 1.01;
  step.move();
  CHECK(refuted(step).count("momentum") == 1);
}
