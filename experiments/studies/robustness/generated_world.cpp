#include "studies/robustness/generated_world.h"

#include "harness/experiment.h"
#include "linear/linear_names.h"
#include "mesh.h"
#include "names.h"
#include "outer/outer_names.h"
#include "scenes/body_shapes.h"
#include "step/integrators.h"
#include "studies/robustness/random.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr int materials = 2;

/// The hull of directions, as it is or with each corner drawn in: then it has hollows.
TriangleMesh lump(Random& random, bool hollow) {
  Points x(3, 6 + random.below(7));
  for (int i = 0; i < 6; ++i) x.col(i) = (i % 2 == 0 ? 1.0 : -1.0) * Vec3::Unit(i / 2);
  for (Eigen::Index i = 6; i < x.cols(); ++i) x.col(i) = random.direction();
  TriangleMesh surface = convex_hull(x);
  const double size = random.uniform(0.15, 0.4);
  for (Eigen::Index i = 0; i < surface.x.cols(); ++i)
    surface.x.col(i) *= size * (hollow ? random.uniform(0.5, 1) : 1);
  return surface;
}

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

/// The world under construction. Body 0 is fixed, with ground or without.
class Building {
 public:
  explicit Building(std::uint64_t begin) : random_(begin) {}

  Scene finish() {
    add_laws();
    add_ground();
    add_bodies();
    if (random_.happens(0.5)) add_joints();
    if (random_.happens(0.4)) add_nodes();
    add_forces();
    if (random_.happens(0.9)) scene_.effects.emplace_back(contact_);
    return std::move(scene_);
  }

 private:
  Random random_;
  Scene scene_;
  Contact contact_;

  double compliance(double low, double high) { return random_.happens(0.5) ? 0 : random_.decades(low, high); }
  /// Of one constraint: without, of all that is here.
  std::vector<double> damping(double probability) {
    if (!random_.happens(probability)) return {};
    return {random_.decades(-4, -1)};
  }
  int moving() { return 1 + random_.below(static_cast<int>(scene_.bodies.size()) - 1); }
  int material() { return random_.below(materials); }

  void add_laws() {
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

  void add_ground() {
    const Vec3 normal = Vec3::UnitZ() + random_.vector(0.3);
    add_body(scene_, Vec3::Zero(), infinity, Vec3::Constant(infinity),
             Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), normal));
    if (random_.happens(0.8)) contact_.collider.push_back({HalfSpace{}, 0, {}, material()});
  }

  void add_bodies() {
    const int count = 1 + random_.below(6);
    const double cell = random_.uniform(0.5, 1), speed = random_.decades(-1, 1);
    for (int i = 0; i < count; ++i) {
      const Vec3 at = cell * Vec3(i % 2, (i / 2) % 2, 0.6 + i / 4) + random_.vector(0.05);
      add_shaped(at, random_.happens(0.5) ? random_.turn() : Eigen::Quaterniond::Identity(), speed);
    }
  }

  void add_shaped(const Vec3& at, const Eigen::Quaterniond& turn, double speed) {
    const Shape shape = any_shape(random_);
    const MassProperties own = shape_properties(shape, random_.decades(2, 5));
    const PrincipalInertia principal = principal_inertia(own.inertia);
    const Eigen::Matrix3d axes = principal.axes.toRotationMatrix();
    const bool held = random_.happens(0.1);
    const Vec3 velocity = random_.vector(speed), spin = random_.vector(3 * speed);
    const int body = add_body(scene_, at + turn * own.centre, held ? infinity : own.mass,
                              held ? Vec3(Vec3::Constant(infinity)) : principal.moments,
                              (turn * principal.axes).normalized(), velocity, spin);
    contact_.collider.push_back(
        {shape, body, {axes.transpose() * -own.centre, axes.transpose()}, material()});
  }

  Vec3 own_point(int body, const Vec3& x) const {
    return scene_.initial.orientation[static_cast<std::size_t>(body)].conjugate() *
           (x - scene_.initial.x.col(scene_.bodies[static_cast<std::size_t>(body)].node));
  }
  Vec3 own_axis(int body, const Vec3& u) const {
    return scene_.initial.orientation[static_cast<std::size_t>(body)].conjugate() * u;
  }

  void add_joints() {
    for (int count = 1 + random_.below(2); count > 0; --count) {
      const int b = moving(), a = random_.below(b);
      const Vec3 x = random_.uniform(0, 1) < 0.5 ? Vec3(scene_.initial.x.col(b)) : random_.vector(0.5);
      add_joint({a, b}, x, random_.direction());
    }
  }

  /// Met as the bodies stand, at x and along u in the world.
  void add_joint(const std::array<int, 2>& body, const Vec3& x, const Vec3& u) {
    const std::array<Vec3, 2> point{own_point(body[0], x), own_point(body[1], x)};
    const std::array<Vec3, 2> axis{own_axis(body[0], u), own_axis(body[1], u)};
    const Vec3 across = u.unitOrthogonal();
    const double length = compliance(-8, -3), angle = compliance(-6, -1);
    const PointJoint ball{{body}, {point}, {length}, damping(0.2)};
    const AxisJoint parallel{{body}, {axis}, {angle}, damping(0.2)};
    const Eigen::Quaterniond rest =
        scene_.initial.orientation[static_cast<std::size_t>(body[0])].conjugate() *
        scene_.initial.orientation[static_cast<std::size_t>(body[1])];
    const RotationJoint turning{{body}, {rest.normalized()}, {angle}, damping(0.2)};
    switch (random_.below(6)) {
      case 0:
        return add(ball);
      case 1:
        add(ball);
        add(parallel);
        return add_drive(body, axis[0], {own_axis(body[0], across), own_axis(body[1], across)});
      case 2:
        add(turning);
        return add_slider(body, point, axis[0], length);
      case 3:
        add(ball);
        return add(PerpendicularJoint{{body}, {{axis[0], own_axis(body[1], across)}}, {angle}, damping(0.2)});
      case 4:
        add(ball);
        return add(turning);
      default: {
        const Vec3 end = x + random_.uniform(0.1, 0.5) * u;
        return add(BodyDistance{{body},
                                {{point[0], own_point(body[1], end)}},
                                {(end - x).norm()},
                                {length},
                                damping(0.2),
                                limits(random_.decades(0, 4))});
      }
    }
  }

  template <class E>
  void add(const E& effect) {
    scene_.effects.emplace_back(effect);
  }

  /// None, a stop, or a motor's.
  std::vector<ForceBounds> limits(double force) {
    if (random_.happens(0.4)) return {};
    if (random_.happens(0.5)) return {{0, infinity}};
    return {{-force, force}};
  }

  void add_drive(const std::array<int, 2>& body, const Vec3& axis, const std::array<Vec3, 2>& reference) {
    if (random_.happens(0.5)) return;
    const auto bounds = limits(random_.decades(0, 3));
    const bool motor = !bounds.empty() && std::isfinite(bounds[0][1]);
    add(AngleJoint{{body},
                   {axis},
                   {reference},
                   {motor ? 0 : random_.uniform(-0.3, 0)},
                   {motor ? random_.uniform(-3, 3) : 0},
                   {bounds.empty() ? random_.decades(-3, 0) : 0},
                   damping(0.2),
                   bounds});
  }

  void add_slider(const std::array<int, 2>& body, const std::array<Vec3, 2>& point, const Vec3& axis,
                  double given) {
    add(LineJoint{{body}, {point}, {axis}, {given}, damping(0.2)});
    if (random_.happens(0.5)) return;
    const auto bounds = limits(random_.decades(0, 4));
    add(SlideJoint{{body},
                   {point},
                   {axis},
                   {bounds.empty() ? 0.05 : -0.05},
                   {0},
                   {bounds.empty() ? random_.decades(-6, -3) : 0},
                   damping(0.2),
                   bounds});
  }

  void add_nodes() {
    const Vec3 corner = Vec3(0, 0, 1.8) + random_.vector(0.1);
    const int first = scene_.nodes();
    std::vector<std::array<int, 3>> triangles;
    switch (random_.below(3)) {
      case 0:
        add_cloth(grid_sheet({3, 2}, {0.6, 0.4}, corner), triangles);
        break;
      case 1:
        add_solid(scene_, kuhn_grid({2, 1, 1}, {0.4, 0.2, 0.2}, corner), random_.decades(2, 4),
                  {random_.decades(4, 7), random_.uniform(0, 0.45)},
                  random_.happens(0.5) ? Strain::corotational : Strain::green);
        if (random_.happens(0.3))
          std::get<TetStrain>(scene_.effects.back()).damping = Material{random_.decades(1, 4), 0.3};
        break;
      default:
        add_rope(corner);
    }
    const Vec3 velocity = random_.vector(random_.decades(-1, 1));
    for (int node = first; node < scene_.nodes(); ++node) scene_.initial.v.col(node) = velocity;
    if (random_.happens(0.4)) hold(first);
    if (random_.happens(0.8)) touch(first, triangles);
  }

  void add_cloth(const TriangleMesh& mesh, std::vector<std::array<int, 3>>& triangles) {
    const int first = add_sheet_nodes(scene_, mesh, random_.decades(-2, 1));
    if (random_.happens(0.5)) {
      add(sheet_links(mesh, first, compliance(-7, -3)));
    } else {
      add(sheet_strain(mesh, first, {random_.decades(4, 8), 0.3}, 1e-3));
    }
    if (random_.happens(0.5)) add(sheet_bending(mesh, first, random_.decades(-2, 3)));
    triangles = mesh.triangles;
    for (auto& triangle : triangles)
      for (int& node : triangle) node += first;
  }

  void add_rope(const Vec3& from) {
    Distance links;
    const double mass = random_.decades(-2, 0), given = compliance(-7, -3), time = random_.decades(-4, -1);
    const bool slow = random_.happens(0.3);
    for (int i = 0; i < 6; ++i) {
      const int node = add_node(scene_, from + Vec3(0.1 * i, 0, 0), mass);
      if (i == 0) continue;
      links.node.push_back({node - 1, node});
      links.rest_length.push_back(0.1);
      links.compliance.push_back(given);
      if (slow) links.damping.push_back(time);
    }
    add(links);
  }

  /// The first node, where it is or by a body.
  void hold(int node) {
    const Vec3 x = scene_.initial.x.col(node);
    if (random_.happens(0.5)) return add(Anchor{{node}, {x}, {compliance(-7, -3)}, damping(0.2)});
    const int body = moving();
    add(Attachment{{body}, {node}, {own_point(body, x)}, {compliance(-7, -3)}, damping(0.2)});
  }

  void touch(int first, const std::vector<std::array<int, 3>>& triangles) {
    const double radius = random_.happens(0.3) ? 0 : random_.uniform(0.01, 0.05);
    const int given = material();
    for (int node = first; node < scene_.nodes(); ++node) {
      contact_.node.push_back(node);
      contact_.radius.push_back(radius);
      contact_.node_material.push_back(given);
    }
    if (random_.happens(0.3)) contact_.triangle = triangles;
  }

  void add_forces() {
    if (random_.happens(0.9)) add(Gravity{});
    if (random_.happens(0.8)) add(Gyroscopic{random_.happens(0.8)});
    if (random_.happens(0.2)) add(ExternalTorque{{moving()}, {random_.vector(random_.decades(-1, 2))}});
    if (random_.happens(0.2))
      add(ExternalForce{{random_.below(scene_.nodes())}, {random_.vector(random_.decades(-1, 3))}});
  }
};

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
  world.method = any_method(random, has_contact(world.scene));
  return world;
}

}  // namespace pbdcheck
