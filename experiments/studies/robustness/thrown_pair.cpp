#include "studies/robustness/thrown_pair.h"

#include <cmath>
#include <numbers>

#include "collision/bounds.h"
#include "harness/experiment.h"
#include "mesh.h"
#include "scenes/body_shapes.h"
#include "studies/robustness/lump.h"

namespace pbdcheck {

using namespace pbd;

namespace {

constexpr double sheet_size = 1, sheet_thickness = 0.01;  // m
constexpr double fastest = 2;                             // decades of sizes a step
constexpr double nearest = 1e-3;                          // of the smaller radius, apart as they begin
constexpr double most_turn = 3;                           // rad a step

bool is_node(Thing thing) {
  return thing == Thing::point || thing == Thing::ball;
}

bool is_fixed(Thing thing) {
  return thing == Thing::half_space || thing == Thing::static_mesh;
}

/// Sides of a shape: compact, or thin along one axis or two.
Vec3 any_sides(Random& random) {
  Vec3 sides(random.uniform(0.3, 1), random.uniform(0.3, 1), random.uniform(0.3, 1));
  if (random.happens(0.5)) return sides;
  const double thin = random.decades(-2, -1);
  const int axis = random.below(3);
  sides[axis] *= thin;
  if (random.happens(0.3)) sides[(axis + 1) % 3] *= thin;
  return sides;
}

TriangleMesh stretched(TriangleMesh surface, const Vec3& sides) {
  surface.x = sides.asDiagonal() * surface.x;
  return surface;
}

Shape shape_of(Thing thing, Random& random) {
  const Vec3 sides = any_sides(random);
  switch (thing) {
    case Thing::sphere:
      return Sphere{sides.x() / 2};
    case Thing::box:
      return Box{sides};
    case Thing::cylinder:
      return Cylinder{sides.x() / 2, sides.z()};
    case Thing::capsule:
      return Capsule{sides.x() / 2, sides.z()};
    case Thing::hull:
      return ConvexHull(stretched(lump(random, false), sides));
    case Thing::mesh:
      return ClosedMesh(stretched(lump(random, true), sides));
    case Thing::static_mesh:
      return ClosedMesh(stretched(lump(random, true), Vec3(10, 10, random.uniform(0.1, 1))));
    default:
      return HalfSpace{};
  }
}

/// One of the two: what of it must stay outside the other one, and what carries it.
struct Thrown {
  Core whole, core;
  std::vector<int> nodes{};
  double radius = 0;  // m, about the origin; of a half space as much as is aimed at
};

/// A scene with two things in it, which are added around the origin.
class Throwing {
 public:
  Throwing(std::uint64_t begin, bool continuous) : random_(begin) {
    contact_.continuous = continuous;
    contact_.thickness = sheet_thickness;
    contact_.law = {ContactLaw{any_share(), any_share()}};
  }

  ThrownPair make(const std::array<Thing, 2>& kinds);

 private:
  double any_share() { return random_.happens(0.3) ? 0 : random_.uniform(0, 1); }
  Thrown add(Thing thing, double mass);
  Thrown add_shaped(Thing thing, double mass);
  Thrown add_sheet(double mass);
  Thrown add_node(Thing thing, double mass);
  void bring_near(const Thrown& first, const Thrown& second, const Vec3& from, double gap);
  void set_moving(const Thrown& thrown, const Vec3& velocity, double most_spin);

  Random random_;
  Scene scene_;
  Contact contact_;
};

Thrown Throwing::add(Thing thing, double mass) {
  if (thing == Thing::sheet) return add_sheet(mass);
  return is_node(thing) ? add_node(thing, mass) : add_shaped(thing, mass);
}

Thrown Throwing::add_node(Thing thing, double mass) {
  const int node = pbd::add_node(scene_, Vec3::Zero(), std::isfinite(mass) ? mass : 1.0);
  const double radius = thing == Thing::point ? 0 : random_.uniform(0.02, 0.2);
  contact_.node.push_back(node);
  contact_.radius.push_back(radius);
  contact_.node_material.push_back(0);
  return {core_of(node, radius, 1), core_of(node, radius, core_share), {node}, radius};
}

Thrown Throwing::add_shaped(Thing thing, double mass) {
  Collider collider{shape_of(thing, random_)};
  const Eigen::Quaterniond turn = random_.turn();
  if (is_fixed(thing)) mass = infinity;
  if (std::isinf(mass)) {
    collider.body = add_body(scene_, Vec3::Zero(), infinity, Vec3::Constant(infinity), turn);
  } else {
    const MassProperties own = with_mass(shape_properties(collider.shape, 1), mass);
    const PrincipalInertia principal = principal_inertia(own.inertia);
    const Eigen::Matrix3d axes = principal.axes.toRotationMatrix();
    collider.body =
        add_body(scene_, turn * own.centre, mass, principal.moments, (turn * principal.axes).normalized());
    collider.frame = {axes.transpose() * -own.centre, axes.transpose()};
  }
  contact_.collider.push_back(collider);
  const double radius = thing == Thing::half_space ? sheet_size : bounding_radius(collider.shape);
  const int node = scene_.bodies[static_cast<std::size_t>(collider.body)].node;
  return {core_of(collider, 1), core_of(collider, core_share), {node}, radius};
}

Thrown Throwing::add_sheet(double mass) {
  constexpr int cells = 2;
  TriangleMesh mesh =
      grid_sheet({cells, cells}, {sheet_size, sheet_size}, {-sheet_size / 2, -sheet_size / 2, 0});
  mesh.x = random_.turn().toRotationMatrix() * mesh.x;
  const bool held = std::isinf(mass);
  const int first = add_sheet_nodes(scene_, mesh, held ? 1 : mass / (sheet_size * sheet_size));
  scene_.effects.emplace_back(sheet_links(mesh, first, random_.happens(0.3) ? 0 : random_.decades(-7, -3)));
  Thrown thrown;
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) {
      const int node = first + i + (cells + 1) * j;
      thrown.nodes.push_back(node);
      if (held && (i % cells == 0 || j % cells == 0)) scene_.mass[static_cast<std::size_t>(node)] = infinity;
    }
  for (auto triangle : mesh.triangles) {
    for (int& node : triangle) node += first;
    contact_.triangle.push_back(triangle);
  }
  thrown.whole = thrown.core = core_of(contact_.triangle);
  thrown.whole.radius = sheet_thickness / 2;
  thrown.radius = sheet_size / std::numbers::sqrt2;
  return thrown;
}

/// Sets the first one `gap` (m) or less from the second one, on the side `from`.
void Throwing::bring_near(const Thrown& first, const Thrown& second, const Vec3& from, double gap) {
  const auto move = [&](double by) {
    for (const int node : first.nodes) scene_.initial.x.col(node) += by * from;
  };
  move(first.radius + second.radius + gap);
  constexpr int times = 3;
  for (int k = 0; k < times; ++k)
    move(std::min(0.0, gap - apart(scene_, first.whole, second.whole, scene_.initial)));
}

void Throwing::set_moving(const Thrown& thrown, const Vec3& velocity, double most_spin) {
  for (const int node : thrown.nodes)
    if (std::isfinite(scene_.mass[static_cast<std::size_t>(node)])) scene_.initial.v.col(node) = velocity;
  if (thrown.core.body >= 0 && random_.happens(0.5))
    scene_.initial.spin.col(thrown.core.body) = random_.uniform(0, most_spin) * random_.direction();
}

ThrownPair Throwing::make(const std::array<Thing, 2>& kinds) {
  ThrownPair pair;
  const double mass = random_.decades(-1, 1);
  const bool fixed = is_fixed(kinds[1]) || random_.happens(0.3);
  const double other = fixed ? infinity : mass * random_.decades(-3, 3);
  const Thrown first = add(kinds[0], mass), second = add(kinds[1], other);
  const double least = is_node(kinds[0]) ? second.radius : std::min(first.radius, second.radius);
  pair.apart = nearest * least;
  const double travel = 2 * least * random_.decades(0, fastest);
  const Vec3 upwards = kinds[1] == Thing::half_space ? Vec3(scene_.initial.orientation.back() * Vec3::UnitZ())
                                                     : random_.direction();
  bring_near(first, second, upwards, pair.apart + random_.uniform(0, 0.8) * travel);
  const Vec3 aim = random_.uniform(0, 1.1) * second.radius * random_.direction();
  const Vec3 against = travel / pair.h * (aim - scene_.initial.x.col(first.nodes.front())).normalized();
  const double share = fixed ? 1 : random_.uniform(0, 1);
  set_moving(first, share * against, most_turn / pair.h);
  if (!fixed) set_moving(second, (share - 1) * against, most_turn / pair.h);
  scene_.effects.emplace_back(contact_);
  pair.scene = std::move(scene_);
  pair.whole = {first.whole, second.whole};
  pair.core = {first.core, second.core};
  pair.steps = 1 + random_.below(3);
  return pair;
}

}  // namespace

std::vector<std::array<Thing, 2>> thrown_pairs() {
  constexpr std::array bodies{Thing::sphere,  Thing::box,  Thing::cylinder,
                              Thing::capsule, Thing::hull, Thing::mesh};
  std::vector<std::array<Thing, 2>> pairs;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t j = i; j < bodies.size(); ++j) pairs.push_back({bodies[i], bodies[j]});
  for (const Thing body : bodies)
    for (const Thing other : {Thing::sheet, Thing::half_space, Thing::static_mesh})
      pairs.push_back({body, other});
  for (const Thing node : {Thing::point, Thing::ball}) {
    for (const Thing body : bodies) pairs.push_back({node, body});
    for (const Thing other : {Thing::half_space, Thing::static_mesh}) pairs.push_back({node, other});
  }
  for (const Thing other : {Thing::half_space, Thing::static_mesh}) pairs.push_back({Thing::sheet, other});
  return pairs;
}

ThrownPair thrown_pair(const std::array<Thing, 2>& kinds, std::int64_t index, bool continuous) {
  const auto kind =
      static_cast<std::uint64_t>(kinds[0]) * thing_names.size() + static_cast<std::uint64_t>(kinds[1]);
  return Throwing(seed + 1000003 * static_cast<std::uint64_t>(index) + (kind << 40), continuous).make(kinds);
}

}  // namespace pbdcheck
