#include "studies/robustness/generated_world.h"

#include "harness/experiment.h"
#include "linear/linear_names.h"
#include "mesh.h"
#include "names.h"
#include "outer/outer_names.h"
#include "scenes/body_shapes.h"
#include "step/integrators.h"
#include "studies/robustness/lump.h"
#include "studies/robustness/world_building.h"

namespace pbdcheck {
namespace {

using namespace pbd;

Shape any_shape(Random& random) {
  const double radius = random.uniform(0.1, 0.25), length = random.uniform(0.2, 0.5);
  switch (random.below(6)) {
    case 0:
      return Sphere{radius};
    case 1: {
      const double x = random.uniform(0.2, 0.5), y = random.uniform(0.2, 0.5);
      return Box{{x, y, length}};
    }
    case 2:
      return Cylinder{radius, length};
    case 3:
      return Capsule{radius, length / 2};
    case 4:
      return ConvexHull(lump(random, false));
    default:
      return ClosedMesh(lump(random, true));
  }
}

}  // namespace

Scene Building::finish() {
  add_laws();
  add_ground();
  add_bodies();
  if (random_.happens(0.5)) add_joints();
  if (random_.happens(0.4)) add_nodes();
  add_forces();
  if (random_.happens(0.9)) scene_.effects.emplace_back(contact_);
  return std::move(scene_);
}

void Building::add_laws() {
  contact_.materials = materials;
  contact_.law.resize(materials * materials);
  for (int a = 0; a < materials; ++a)
    for (int b = a; b < materials; ++b) {
      ContactLaw law;
      law.friction = random_.happens(0.2) ? 0 : random_.uniform(0, 1.2);
      law.restitution = random_.happens(0.3) ? random_.uniform(0, 1) : 0;
      if (random_.happens(0.2)) {
        law.compliance = random_.decades(-7, -4);
        if (random_.happens(0.5)) law.damping = random_.decades(-4, -1);
      }
      contact_.law[a * materials + b] = contact_.law[b * materials + a] = law;
    }
  if (random_.happens(0.3)) contact_.recovery = random_.decades(-1, 1);
  if (random_.happens(0.3)) contact_.margin = random_.decades(-3, -1);
}

void Building::add_ground() {
  const Vec3 normal = Vec3::UnitZ() + random_.vector(0.3);
  add_body(scene_, Vec3::Zero(), infinity, Vec3::Constant(infinity),
           Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), normal));
  if (random_.happens(0.8)) contact_.collider.push_back({HalfSpace{}, 0, {}, material()});
}

void Building::add_bodies() {
  const int count = 1 + random_.below(6);
  const double cell = random_.uniform(0.5, 1), speed = random_.decades(-1, 1);
  for (int i = 0; i < count; ++i) {
    const int layer = i / 4;
    const Vec3 at = cell * Vec3(i % 2, (i / 2) % 2, 0.6 + layer) + random_.vector(0.05);
    add_shaped(at, random_.happens(0.5) ? random_.turn() : Eigen::Quaterniond::Identity(), speed);
  }
}

void Building::add_shaped(const Vec3& at, const Eigen::Quaterniond& turn, double speed) {
  const Shape shape = any_shape(random_);
  const MassProperties own = shape_properties(shape, random_.decades(2, 5));
  const PrincipalInertia principal = principal_inertia(own.inertia);
  const Eigen::Matrix3d axes = principal.axes.toRotationMatrix();
  const bool held = random_.happens(0.1);
  const Vec3 velocity = random_.vector(speed), spin = random_.vector(3 * speed);
  const int body = add_body(scene_, at + turn * own.centre, held ? infinity : own.mass,
                            held ? Vec3(Vec3::Constant(infinity)) : principal.moments,
                            (turn * principal.axes).normalized(), velocity, spin);
  contact_.collider.push_back({shape, body, {axes.transpose() * -own.centre, axes.transpose()}, material()});
}

void Building::add_forces() {
  if (random_.happens(0.9)) add(Gravity{});
  if (random_.happens(0.8)) add(Gyroscopic{random_.happens(0.8)});
  if (random_.happens(0.2)) add(ExternalTorque{{moving()}, {random_.vector(random_.decades(-1, 2))}});
  if (random_.happens(0.2))
    add(ExternalForce{{random_.below(scene_.nodes())}, {random_.vector(random_.decades(-1, 3))}});
}

namespace {

bool has_contact(const Scene& scene) {
  return !scene.effects.empty() && std::holds_alternative<Contact>(scene.effects.back());
}

Method any_method(Random& random, bool contact) {
  Method method;
  do method.integrator = random.one_of(integrators()).name;
  while (contact && !find_named(integrators(), "integrator", method.integrator).contact);
  const auto solvers = general_solver_names();
  if (random.happens(0.6)) method.relaxation = random.one_of(solvers);
  if (random.happens(0.2)) method.outer = random.happens(0.5) ? "plain" : "proximal";
  if (contact && random.happens(0.4)) method.friction = random.one_of(friction_names);
  method.warm_start = random.happens(0.8);
  return method;
}

}  // namespace

World generated_world(std::int64_t index) {
  Random random(seed + 1000003 * static_cast<std::uint64_t>(index));
  World world;
  world.h = random.decades(-3, -1.5);
  world.scene = Building(seed ^ (static_cast<std::uint64_t>(index) << 20)).finish();
  for (Effect& effect : world.scene.effects)
    if (auto* contact = std::get_if<Contact>(&effect)) contact->continuous = index % 5 == 4;
  const bool contact = has_contact(world.scene);
  world.method = any_method(random, contact);
  if (contact && index % 8 == 6)  // those that begin anew at impacts, which `any_method` does not draw
    world.method.integrator = index % 16 == 6 ? "bdf2" : "generalised_alpha";
  return world;
}

}  // namespace pbdcheck
