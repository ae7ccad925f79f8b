// What yields where it touches: a spring from where the shapes touch, however deep it is loaded, and whatever
// comes back where they collide.
#include "body_scenes.h"
#include "contact_runs.h"
#include "scenes/contacts.h"
#include "touching_sheets.h"

using namespace pbd;
using namespace pbd::test;
using namespace pbdcheck;

namespace {

/// Of a mass m on a spring of compliance A: the share that implicit Euler leaves of its motion, a factor
/// (1 + h^2/(A m))^-1/2 a step.
double motion_left(double compliance, double mass, double h, int steps) {
  return std::pow(1 + h * h / (compliance * mass), -steps / 2.0);
}

}  // namespace

TEST_CASE(
    "what yields comes to rest where its spring holds it, whatever it bounces by and overlaps recover by") {
  constexpr double mass = 2, radius = 0.1;
  const double compliance = GENERATE(1e-5, 1e-4), h = GENERATE(5e-3, 1e-3);
  const double restitution = GENERATE(0.0, 0.1, 0.5), recovery = GENERATE(1e-3, infinity);
  const bool on_box = GENERATE(false, true);
  BodyScene build({.friction = 0.5, .restitution = restitution, .compliance = compliance});
  if (on_box)
    build.fixed(Box{Vec3(1, 1, 0.2)}, {Vec3(0, 0, -0.1)});
  else
    build.ground();
  build.ball(radius, mass, {.position = {0, 0, radius}});
  build.contact().recovery = recovery;
  const Scene scene = build.finish();
  const int steps = static_cast<int>(std::lround(1 / h));
  const State end = run(scene, contact_method("direct"), h, steps);
  const double deep = compliance * weight(scene);
  INFO("compliance " << compliance << ", h " << h << ", restitution " << restitution << ", recovery "
                     << recovery);
  CHECK(std::abs(end.x(2, 1) - (radius - deep)) <= deep * motion_left(compliance, mass, h, steps) + 1e-11);
}

TEST_CASE("what yields is thrown back by its restitution from where it is met, however soft it is") {
  const double compliance = GENERATE(1e-6, 1e-4, 1e-2), restitution = GENERATE(0.5, 1.0),
               speed = GENERATE(1.0, 200.0);
  constexpr double radius = 0.1, h = 0.01;
  BodyScene build({.friction = 0, .restitution = restitution, .compliance = compliance}, 0);
  build.ground();
  const double gap = speed * h / 2;
  build.ball(radius, 1, {.position = {0, 0, radius + gap}, .velocity = {0, 0, -speed}});
  const State end = run(build.finish(), contact_method("direct"), h, 1);
  INFO("compliance " << compliance << ", restitution " << restitution << ", speed " << speed);
  CHECK(std::abs(end.v(2, 1) - restitution * speed) <= 1e-9 * speed);
}

TEST_CASE(
    "a cube that yields on a flat mesh has a spring at each corner, and none where its edges cross "
    "diagonals") {
  const double deep = GENERATE(1e-3, 0.013), turned = GENERATE(0.0, 0.2, 0.7);
  const bool own_mesh = GENERATE(false, true);
  constexpr double compliance = 1e-4, h = 0.01, mass = 2, side = 0.6;
  const Vec3 size = Vec3::Constant(side);
  BodyScene build({.friction = 0.5, .compliance = compliance}, 0);
  build.fixed(ClosedMesh(box_surface(Vec3(4, 4, 2))), {Vec3(0, 0, -1)});
  build.box(
      size, mass,
      {Vec3(0.13, -0.07, side / 2 - deep), Eigen::Quaterniond(Eigen::AngleAxisd(turned, Vec3::UnitZ()))});
  if (own_mesh) build.contact().collider.back().shape = ClosedMesh(box_surface(size));
  const State end = run(build.finish(), contact_method("direct"), h, 1);
  INFO("deep " << deep << ", turned " << turned << ", own mesh " << own_mesh);
  const double expected = 4 * h * deep / (compliance * mass + 4 * h * h);
  CHECK((Vec3(end.v.col(1)) - expected * Vec3::UnitZ()).norm() <= 1e-9 * expected);
  CHECK(end.spin.col(1).norm() <= 1e-9 * expected / side);
}

TEST_CASE("a cloth laid on a box that yields presses on it by its weight") {
  const double compliance = GENERATE(1e-4, 1e-3), h = GENERATE(1e-2, 2e-3);
  BodyScene build({.friction = 0.5, .compliance = compliance});
  build.fixed(Box{Vec3(0.5, 0.5, 0.1)}, {Vec3(0, 0, -0.05)});
  Scene scene = build.finish();
  constexpr int cells = 4;
  constexpr double size = 0.2, density = 50;  // m, kg/m^2
  add_surface(scene, sheet(cells, size, thickness / 2), false, density);
  const Method method = contact_method("direct");
  Workspace workspace(scene, method);
  State state = scene.initial;
  Vec3 force = Vec3::Zero();
  const int steps = static_cast<int>(std::lround(2 / h));
  for (int k = 0; k < steps; ++k) REQUIRE(step(workspace, h, state).status == Status::ok);
  for (const ContactForce& each : workspace.contacts())
    force += (each.collider[0] == 0 ? -1 : 1) * each.force;
  INFO("compliance " << compliance << ", h " << h);
  const double heaviest = density * std::pow(size / cells, 2);  // node, kg
  CHECK(std::abs(force.z() / weight(scene) - 1) <= motion_left(compliance, heaviest, h, steps) + 1e-9);
}
