// Each deformable surface has its own material.
#include "contact_runs.h"
#include "mesh.h"
#include "pressed_surfaces.h"
#include "scenes/contacts.h"
#include "touching_sheets.h"

using namespace pbd;
using namespace pbd::test;
using namespace pbdcheck;

TEST_CASE("of two sheets on a slope one slides and one sticks, as their materials rub on the ground") {
  constexpr double angle = 0.3, h = 0.005;
  constexpr int steps = 40;
  const Eigen::Quaterniond tilt(Eigen::AngleAxisd(angle, Vec3::UnitY()));
  const std::array<double, 2> friction{1.05 * std::tan(angle), 0.8 * std::tan(angle)};
  BodyScene build({.friction = 0.1});
  build.ground(angle);
  build.materials(3, {.friction = 0.1});
  for (const int k : {0, 1}) build.law(0, k + 1, {.friction = friction[k]});
  Scene scene = build.finish();
  std::array<int, 2> first{};
  for (const int k : {0, 1}) {
    TriangleMesh mesh = sheet(2, 0.2, pbd::test::thickness / 2);
    mesh.x.row(1).array() += 0.3 * k;
    mesh.x = (tilt.toRotationMatrix() * mesh.x).eval();
    first[k] = add_surface(scene, mesh, false);
    Contact& contact = contact_in(scene);
    contact.triangle_material.resize(contact.triangle.size(), k + 1);
  }
  const State end = run(scene, contact_method("direct"), h, steps);
  for (const int k : {0, 1}) {
    const double slope = gravity * (std::sin(angle) - friction[k] * std::cos(angle));
    const double expected = slope > 0 ? slope * h * h * steps * (steps + 1) / 2 : 0;
    INFO("friction " << friction[k]);
    for (int node = first[k]; node < first[k] + 9; ++node) {
      const Vec3 moved = tilt.conjugate() * Vec3(end.x.col(node) - scene.initial.x.col(node));
      CHECK((moved - Vec3(expected, 0, 0)).norm() <= 1e-8);
    }
  }
}

TEST_CASE("surfaces and spheres on them rub and yield by the law of their two materials") {
  const auto pressing = GENERATE(Pressing::node, Pressing::edge, Pressing::sphere);
  const double compliance = GENERATE(0.0, 1e-4);
  const PressedSurfaces pressed(pressing, {.friction = 0.3, .compliance = compliance});
  const State end = run(pressed.scene, contact_method("direct"), PressedSurfaces::h, 1);
  INFO("case " << static_cast<int>(pressing) << ", compliance " << compliance);
  for (const int node : pressed.nodes) CHECK((Vec3(end.v.col(node)) - pressed.after()).norm() <= 1e-9);
}
