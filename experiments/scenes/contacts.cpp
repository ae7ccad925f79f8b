#include "scenes/contacts.h"

#include <cmath>
#include <numbers>

#include "boundary.h"
#include "mass_properties.h"

namespace pbdcheck {

using namespace pbd;

const Contact* contact_of(const Scene& scene) {
  for (const auto& effect : scene.effects)
    if (const auto* contact = std::get_if<Contact>(&effect)) return contact;
  return nullptr;
}

int add_touching_solid(Scene& scene, const TetMesh& mesh, double density, const Material& material,
                       Strain strain) {
  const int first = add_solid(scene, mesh, density, material, strain);
  for (Effect& effect : scene.effects)
    if (auto* contact = std::get_if<Contact>(&effect))
      for (const auto& [a, b, c] : boundary(mesh))
        contact->triangle.push_back({first + a, first + b, first + c});
  return first;
}

BodyScene::BodyScene(const ContactLaw& law, double gravity) {
  contact_.law = {law};
  scene_.effects = {Gravity{{0, 0, -gravity}}, Gyroscopic{}};
}

int BodyScene::add(const Shape& shape, double mass, const Vec3& inertia, const Placing& at, int material) {
  const int body = add_body(scene_, at.position, mass, inertia, at.orientation, at.velocity, at.spin);
  contact_.collider.push_back({shape, body, {}, material});
  return body;
}

int BodyScene::fixed(const Shape& shape, const Placing& at, int material) {
  return add(shape, infinity, Vec3::Constant(infinity), at, material);
}

int BodyScene::box(const Vec3& size, double mass, const Placing& at, int material) {
  const Vec3 inertia = with_mass(box_properties(size, 1), mass).inertia.diagonal();
  return add(Box{size}, mass, inertia, at, material);
}

int BodyScene::ball(double radius, double mass, const Placing& at, int material) {
  const Vec3 inertia = with_mass(sphere_properties(radius, 1), mass).inertia.diagonal();
  return add(Sphere{radius}, mass, inertia, at, material);
}

int BodyScene::cylinder(double radius, double length, double mass, const Placing& at, int material) {
  const Vec3 inertia = with_mass(cylinder_properties(radius, length, 1), mass).inertia.diagonal();
  return add(Cylinder{radius, length}, mass, inertia, at, material);
}

int BodyScene::add_filled(const Shape& shape, const TriangleMesh& surface, double density, const Placing& at,
                          int material) {
  const MassProperties own = surface_properties(surface, density);
  const PrincipalInertia principal = principal_inertia(own.inertia);
  const Eigen::Matrix3d axes = principal.axes.toRotationMatrix();
  Placing centre = at;
  centre.position += at.orientation * own.centre;
  centre.orientation = at.orientation * principal.axes;
  const int body = add(shape, own.mass, principal.moments, centre, material);
  contact_.collider.back().frame = {axes.transpose() * -own.centre, axes.transpose()};
  return body;
}

int BodyScene::hull(const ConvexHull& hull, double density, const Placing& at, int material) {
  return add_filled(hull, hull.surface, density, at, material);
}

int BodyScene::mesh(const ClosedMesh& mesh, double density, const Placing& at, int material) {
  return add_filled(mesh, mesh.surface, density, at, material);
}

int BodyScene::ground(double angle, int material) {
  const Eigen::Quaterniond tilt(Eigen::AngleAxisd(angle, Vec3::UnitY()));
  return fixed(HalfSpace{}, {Vec3::Zero(), tilt}, material);
}

void BodyScene::materials(int count, const ContactLaw& all) {
  contact_.materials = count;
  contact_.law.assign(static_cast<std::size_t>(count) * static_cast<std::size_t>(count), all);
}

void BodyScene::law(int first, int second, const ContactLaw& law) {
  const int count = contact_.materials;
  for (const int entry : {first * count + second, second * count + first})
    contact_.law[static_cast<std::size_t>(entry)] = law;
}

Scene BodyScene::finish() const {
  Scene scene = scene_;
  scene.effects.emplace_back(contact_);
  return scene;
}

Scene slipping(Round shape) {
  constexpr double radius = 0.1, speed = 1;
  BodyScene build({.friction = 0.2});
  build.ground();
  const Eigen::Quaterniond lying(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX()));
  if (shape == Round::ball)
    build.ball(radius, 1, {Vec3(0, 0, radius), Eigen::Quaterniond::Identity(), Vec3(speed, 0, 0)});
  else
    build.cylinder(radius, 0.2, 1, {Vec3(0, 0, radius), lying, Vec3(speed, 0, 0)});
  Scene scene = build.finish();
  if (shape == Round::hoop) scene.bodies[1].inertia.z() = radius * radius;
  return scene;
}

Scene sliding_box(double angle, double friction, double speed, double heading, const Vec3& size) {
  BodyScene build({.friction = friction});
  build.ground(angle);
  const Eigen::Quaterniond tilt(Eigen::AngleAxisd(angle, Vec3::UnitY()));
  const Vec3 velocity = speed * Vec3(std::cos(heading), std::sin(heading), 0);
  build.box(size, 4, {tilt * Vec3(0, 0, size.z() / 2), tilt, tilt * velocity});
  return build.finish();
}

namespace {

constexpr double edge = 0.2;  // m, of stacked cubes
constexpr double cube_mass = 8;

}  // namespace

Scene column(int count, double ratio) {
  BodyScene build({.friction = 0.5});
  build.ground();
  for (int k = 0; k < count; ++k)
    build.box(Vec3::Constant(edge), cube_mass * std::pow(ratio, k), {Vec3(0, 0, (k + 0.5) * edge)});
  return build.finish();
}

Scene pyramid(int base) {
  BodyScene build({.friction = 0.5});
  build.ground();
  constexpr double pitch = 1.1 * edge;
  for (int row = 0; row < base; ++row)
    for (int k = 0; k < base - row; ++k)
      build.box(Vec3::Constant(edge), cube_mass,
                {Vec3((k + 0.5 * row - 0.5 * (base - 1)) * pitch, 0, (row + 0.5) * edge)});
  return build.finish();
}

Scene pile() {
  BodyScene build({.friction = 0.5});
  build.ground();
  const Vec3 cube = Vec3::Constant(edge);
  for (const double x : {-0.11, 0.11}) build.box(cube, 8, {Vec3(x, 0, 0.1)});
  build.box(cube, 8, {Vec3(0, 0, 0.3)});
  build.box({0.3, 0.2, 0.05}, 2, {.position = {0.02, 0, 0.425}, .velocity = {0.8, 0.3, 0}});
  build.box(cube, 8, {.position = {-0.8, 0, 0.1}, .velocity = {1, 0.7, 0}});
  build.box(cube, 8, {.position = {0.8, 0, 0.1}, .velocity = {0.2, 0, 0.5}});
  build.ball(0.1, 4, {.position = {0, 0.6, 0.1}, .spin = {0, 20, 5}});
  return build.finish();
}

}  // namespace pbdcheck
