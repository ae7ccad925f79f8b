// A true step, made by hand, is not refuted; with one number of it changed it is, by the check of that law.
#include <catch2/catch.hpp>
#include <cmath>

#include "claimed_step.h"
#include "scenes/contacts.h"

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

/// A box of 4 kg and 0.1 m height on the ground, as contacts() counts them: 0 the ground, 1 the box.
Step box_on_ground(double friction, double speed) {
  pbdcheck::BodyScene scene(ContactLaw{.friction = friction}, g);
  scene.ground();
  scene.box({0.2, 0.2, 0.1}, 4, {.position = {0, 0, 0.05}, .velocity = {speed, 0, 0}});
  Step step(scene.finish());
  const double drag = speed > 0 ? friction * 4 * g : 0;
  step.end.v.col(1).x() -= h * drag / 4;
  step.move();
  // Friction turns the box forward: the pressure moves so far ahead that it does not turn.
  const double ahead = drag * 0.05 / (4 * g), share = ahead / 0.2;
  for (const double x : {-0.1, 0.1})
    for (const double y : {-0.1, 0.1}) {
      const double part = 0.25 + (x > 0 ? share : -share) / 2;
      step.contacts.push_back({.collider = {1, 0},
                               .point = step.end.x.col(1) + Vec3(x, y, -0.05),
                               .normal = Vec3::UnitZ(),
                               .force = {-drag * part, 0, 4 * g * part},
                               .gap = 0});
    }
  return step;
}

/// Balls of 0.1 m; the first meets the second, without restitution, and both go on together.
Step balls() {
  pbdcheck::BodyScene scene(ContactLaw{.friction = 0}, 0);
  scene.ball(0.1, 1, {.position = {-0.102, 0, 0}, .velocity = {1, 0, 0}});
  scene.ball(0.1, 3, {.position = {0.1, 0, 0}});
  Step step(scene.finish());
  // The gap of 2 mm closes: v0 - v1 = 0.2 m/s, v0 + 3 v1 = 1 m/s.
  const double after = 0.2;
  step.end.v.col(0).x() = after + 0.2;
  step.end.v.col(1).x() = after;
  step.move();
  step.contacts.push_back({.collider = {0, 1},
                           .point = (step.end.x.col(0) + step.end.x.col(1)) / 2,
                           .normal = -Vec3::UnitX(),
                           .force = {-3 * after / h, 0, 0},
                           .gap = 0});
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
  }
  // Gravity may be allowed h g (v1 - v0)/2 alone, which is what it gives a ball that keeps its speed.
  CHECK(refuted(bounce(1, 1 + 1e-6)) == Names{"energy", "rebound"});
  CHECK(refuted(bounce(1, 1, 100)).empty());  // another ball falls far beside it
  CHECK(refuted(bounce(1, 1.1, 100)) == Names{"energy", "rebound"});
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

TEST_CASE("contacts: force, cone, slip, gap and depth") {
  Step turned = box_on_ground(0.5, 1);
  for (auto& contact : turned.contacts) contact.force.x() *= -1;
  CHECK(refuted(turned) == Names{"angular momentum", "momentum", "sliding"});

  Step beyond = box_on_ground(0.5, 1);
  beyond.scene.effects.back() = [&] {
    auto contact = std::get<Contact>(beyond.scene.effects.back());
    contact.law[0].friction = 0.49;
    return contact;
  }();
  CHECK(refuted(beyond) == Names{"friction", "sliding"});

  Step idle = box_on_ground(0.5, 1);
  idle.contacts[0].force.x() *= 0.9;  // another takes its share
  idle.contacts[1].force.x() += 0.1 / 0.9 * idle.contacts[0].force.x();
  CHECK(refuted(idle).count("sliding") == 1);

  Step pulls = box_on_ground(0.5, 0);
  for (const int sign : {-1, 1}) {  // two pull as others push more
    pulls.contacts[sign < 0 ? 0 : 1].force.z() += 20 * sign;
    pulls.contacts[sign < 0 ? 3 : 2].force.z() += 20 * sign;
  }
  CHECK(refuted(pulls).count("contact pulls") == 1);

  Step open = balls();
  open.contacts[0].gap = 1e-6;
  CHECK(refuted(open) == Names{"open contact"});
  open.contacts[0].gap = -1e-6;
  CHECK(refuted(open) == Names{"gap told"});

  Step deep = balls();  // as if they had not met
  deep.contacts.clear();
  deep.end.v = deep.scene.initial.v;
  deep.move();
  CHECK(refuted(deep) == Names{"depth"});
}

TEST_CASE("contacts: force, cone, slip and depth under integrators of second order") {
  for (const std::string_view integrator : {"newmark", "bdf2", "generalised_alpha"}) {
    INFO(integrator);
    Step step = box_on_ground(0.5, 1);
    step.integrator = integrator;
    CHECK(refuted(step).empty());
    for (auto& contact : step.contacts) contact.force.x() *= -1;
    CHECK(refuted(step) == Names{"sliding"});
    for (auto& contact : step.contacts) contact.force *= -1;
    CHECK(refuted(step) == Names{"contact pulls", "friction", "sliding"});
    Step deep = balls();
    deep.integrator = integrator;
    CHECK(refuted(deep).empty());
    deep.end.x(0, 0) += 1e-3;
    CHECK(refuted(deep) == Names{"depth"});
  }
}

TEST_CASE("contacts: a belt drags by its slip, and brings energy") {
  Step step = box_on_ground(0.5, 1);  // seen by who goes along with the box
  step.scene.initial.v(0, 1) -= 1;
  step.end.v(0, 1) -= 1;
  step.move();
  for (auto& contact : step.contacts) contact.point.x() -= h;
  const auto set_belt = [&](double speed) {
    std::get<Contact>(step.scene.effects.back()).collider[0].surface_velocity.x() = speed;
  };
  set_belt(-1);
  CHECK(refuted(step).empty());
  for (const double other : {0.0, 1.0}) {
    set_belt(other);
    CHECK(refuted(step) == Names{"energy", "sliding"});
  }
}

TEST_CASE("contacts: a ball in a triangle of a surface, and what a surface carries") {
  constexpr double thickness = 0.01, radius = 0.1, fall = 0.1;  // m, m/s
  const auto falling = [&](double gap) {
    Scene scene;
    add_body(scene, Vec3(0.1, 0.1, radius + thickness / 2 + gap), 2, Vec3::Constant(0.01),
             Eigen::Quaterniond::Identity(), Vec3(0, 0, -fall));
    Contact contact;
    contact.thickness = thickness;
    contact.collider.push_back({Sphere{radius}, 0});
    for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}) add_node(scene, x, infinity);
    contact.triangle.push_back({1, 2, 3});
    scene.effects.emplace_back(contact);
    Step step(scene);
    step.move();
    return step;
  };
  CHECK(refuted(falling(Step::h * fall + 1e-9)).empty());
  CHECK(refuted(falling(Step::h * fall - 2e-4 * radius)) == Names{"depth"});

  Step stopped = falling(Step::h * fall / 2);  // the surface takes half of the speed
  stopped.end.v.col(0) /= 2;
  stopped.move();
  const Vec3 force(0, 0, 2 * fall / 2 / Step::h);
  stopped.contacts.push_back({{0, 2}, Vec3(0.1, 0.1, 0), Vec3::UnitZ(), force, 0});
  CHECK(refuted(stopped).empty());
  stopped.contacts[0].force *= 1.001;
  CHECK(refuted(stopped) == Names{"momentum"});
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
