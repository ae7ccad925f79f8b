#include "studies/contact/coupling_scenes.h"

#include <cmath>
#include <numbers>

#include "scenes/contacts.h"

namespace pbdcheck {

using namespace pbd;

namespace {

constexpr double density = cube_mass / (cube_size * cube_size * cube_size);  // kg/m^3
constexpr double thickness = 2e-3;                                           // m

TetMesh cube(int cells, const Vec3& corner) {
  return kuhn_grid({cells, cells, cells}, Vec3::Constant(cube_size), corner);
}

/// With its middle above the origin, as if it lay on the ground.
TetMesh standing_cube(int cells) {
  return cube(cells, Vec3(-cube_size / 2, -cube_size / 2, thickness / 2));
}

}  // namespace

Scene ball_strikes_cube(double ratio) {
  constexpr double radius = 0.05;
  BodyScene build({.friction = 0.3}, 0);
  build.ball(radius, ratio * cube_mass,
             {.position = Vec3(0.13, 0.08, cube_size + radius + 4 * thickness),
              .velocity = Vec3(0, 0.3, -impact_speed),
              .spin = Vec3(5, 0, 0)});
  build.contact().thickness = thickness;
  Scene scene = build.finish();
  add_touching_solid(scene, cube(3, Vec3::Zero()), density, {1e5, 0.3}, Strain::corotational);
  return scene;
}

Scene cubes_meet() {
  Scene scene;
  Contact contact;
  contact.thickness = thickness;
  contact.law = {{.friction = 0.3}};
  scene.effects.emplace_back(contact);
  for (const double side : {-1.0, 1.0}) {
    const Vec3 corner(side < 0 ? -cube_size - 2 * thickness : 2 * thickness, 0.03 * side, 0.02 * side);
    const int first = add_touching_solid(scene, cube(3, corner), density, {side < 0 ? 1e5 : 3e5, 0.3},
                                         Strain::corotational);
    scene.initial.v.rightCols(scene.nodes() - first).colwise() =
        Vec3(-side * impact_speed / 2, 0.1 * side, 0);
  }
  return scene;
}

Scene pressed_cube(Strain strain, double poisson, double share) {
  constexpr double young = 1e5, plate = 0.05;
  BodyScene build({.friction = 0}, 0);
  build.ground();
  build.box(Vec3(1.5 * cube_size, 1.5 * cube_size, plate), 20,
            {Vec3(0, 0, thickness + cube_size + plate / 2)});
  build.contact().thickness = thickness;
  Scene scene = build.finish();
  scene.bodies[1].inertia.setConstant(infinity);  // a plate that tilts slides off
  add_touching_solid(scene, standing_cube(2), density, {young, poisson}, strain);
  scene.effects.emplace_back(ExternalForce{{1}, {Vec3(0, 0, -share * young * cube_size * cube_size)}});
  return scene;
}

Scene box_on_cube(double ratio, double strain) {
  constexpr double box = 0.1;
  const double mass = ratio * cube_mass;
  BodyScene build({.friction = 0.5});
  build.ground();
  build.box(Vec3::Constant(box), mass, {Vec3(0.01, -0.02, thickness + cube_size + box / 2)});
  build.contact().thickness = thickness;
  Scene scene = build.finish();
  const double young = (mass + cube_mass) * gravity / (cube_size * cube_size * strain);
  add_touching_solid(scene, standing_cube(4), density, {young, 0.3}, Strain::corotational);
  return scene;
}

Scene rope_on_cylinder(int arc, double friction, double pull) {
  constexpr double radius = 0.1, mass = 0.01;  // m, kg a node
  BodyScene build({.friction = friction}, 0);
  build.fixed(Cylinder{radius, 0.1},
              {.position = Vec3::Zero(),
               .orientation = Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX()))});
  const double turn = std::numbers::pi / arc, link = 2 * radius * std::sin(turn / 2);
  std::vector<Vec3> place;
  for (int k = arc; k > 0; --k) place.emplace_back(-radius, 0, -k * link);
  for (int k = 0; k <= arc; ++k)
    place.emplace_back(-radius * std::cos(k * turn), 0, radius * std::sin(k * turn));
  for (int k = 1; k <= arc; ++k) place.emplace_back(radius, 0, -k * link);
  Contact& contact = build.contact();
  const auto count = place.size();
  for (std::size_t i = 0; i < count; ++i) contact.node.push_back(1 + static_cast<int>(i));
  contact.radius.assign(count, 0);
  contact.node_material.assign(count, 0);
  Scene scene = build.finish();
  Distance rope;
  for (std::size_t i = 0; i < count; ++i) {
    const int node = add_node(scene, place[i], mass);
    if (i > 0) rope.node.push_back({node - 1, node});
  }
  rope.rest_length.assign(rope.node.size(), link);
  rope.compliance.assign(rope.node.size(), 0);
  scene.effects.emplace_back(rope);
  scene.effects.emplace_back(
      ExternalForce{{1, static_cast<int>(count)}, {Vec3(0, 0, -1), Vec3(0, 0, -pull)}});
  return scene;
}

}  // namespace pbdcheck
