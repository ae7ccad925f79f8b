// Tables of rigid bodies and of what acts on them: torques, the gyroscopic torque.
#include <fmt/format.h>

#include <Eigen/Geometry>

#include "scenes/body_copies.h"
#include "scenes/builder.h"
#include "scenes/choices.h"
#include "scenes/mesh_file.h"

namespace pbdcheck {
namespace {

struct BodyMotion {
  pbd::Vec3 velocity, angular_velocity;  // in the world
};

/// A body's mass, its centre of mass and principal axes in the shape's frame, its principal moments.
struct Inertia {
  double mass;
  pbd::Vec3 centre = pbd::Vec3::Zero();
  pbd::PrincipalInertia principal{pbd::Vec3::Ones(), Eigen::Quaterniond::Identity()};
};

pbd::TriangleMesh scaled(Keys& keys, pbd::TriangleMesh mesh) {
  mesh.x *= keys.number_or("scale", 1, Range::positive);
  return mesh;
}

Shape read_shape(Keys& keys, Builder& builder) {
  if (!keys.has("shape")) return {};
  const auto kind =
      keys.choice_or("shape", "", {"sphere", "box", "cylinder", "capsule", "mesh", "hull", "half_space"});
  if (kind == "half_space") return HalfSpace{};
  if (kind == "box") {
    const auto size = keys.numbers("size_m", 3, Range::positive);
    return Box{{size[0], size[1], size[2]}};
  }
  if (kind == "mesh" || kind == "hull") {
    const auto path = mesh_path(keys);
    auto surface = kind == "mesh"
                       ? read_triangle_mesh(path)
                       : located(mesh_name(keys), [&] { return convex_hull(read_mesh_nodes(path)); });
    surface = scaled(keys, std::move(surface));
    if (kind == "mesh") builder.reserve(keys, "file", static_cast<double>(surface.triangles.size()));
    return located(mesh_name(keys), [&]() -> Shape {
      if (kind == "hull") return ConvexHull(std::move(surface));
      return ClosedMesh(std::move(surface));
    });
  }
  const double radius = keys.number("radius_m", Range::positive);
  if (kind == "sphere") return Sphere{radius};
  const double length = keys.number("length_m", Range::positive);
  if (kind == "cylinder") return Cylinder{radius, length};
  return Capsule{radius, length};
}

/// Refuses what over- or underflows.
void require_inertia(const Keys& keys, double mass, const pbd::Vec3& moments) {
  const auto within = [](double value) { return value > 0 && value <= largest_number; };
  if (!within(mass) || !within(moments.minCoeff()) || !within(moments.maxCoeff()))
    throw pbd::SetupError(keys.where(),
                          fmt::format("mass {} kg, moments of inertia {}, {}, {} kg m^2", mass, moments[0],
                                      moments[1], moments[2]),
                          "sizes and densities that make mass and moments > 0, up to 1e100");
}

/// Of the body of a shape, by one of `density_kg_m3` and `mass_kg`; none is needed where it is held.
Inertia read_shape_inertia(Keys& keys, const Shape& shape, bool held) {
  const bool dense = keys.has("density_kg_m3"), heavy = keys.has("mass_kg");
  if (dense && heavy) keys.refuse("mass_kg", "a density and a mass", "one of them");
  if (!dense && !heavy && !held) keys.refuse("density_kg_m3", "nothing", "density_kg_m3 or mass_kg");
  if (keys.has("inertia_kg_m2"))
    keys.refuse("inertia_kg_m2", "a shape and moments of inertia", "one of them");
  const double density = keys.number_or("density_kg_m3", 1, Range::positive);
  auto found = located(mesh_name(keys), [&] { return shape_properties(shape, density); });
  if (heavy) found = pbd::with_mass(found, keys.number("mass_kg", Range::positive));
  require_inertia(keys, found.mass, found.inertia.diagonal());
  Inertia inertia{found.mass, found.centre, pbd::principal_inertia(found.inertia)};
  require_inertia(keys, found.mass, inertia.principal.moments);
  return inertia;
}

/// A half space is fixed, and needs none.
Inertia read_no_inertia(Keys& keys) {
  for (const auto* key : {"density_kg_m3", "mass_kg", "inertia_kg_m2"})
    if (keys.has(key)) keys.refuse(key, "a mass of a half space", "none: it is fixed");
  return {1};
}

Inertia read_given_inertia(Keys& keys, bool held) {
  if (keys.has("density_kg_m3"))
    keys.refuse("density_kg_m3", "a density without a shape", "mass_kg and inertia_kg_m2, or a shape");
  Inertia inertia{1};
  if (!held || keys.has("mass_kg")) inertia.mass = keys.number("mass_kg", Range::positive);
  if (!held || keys.has("inertia_kg_m2")) {
    const auto moments = keys.numbers("inertia_kg_m2", 3, Range::positive);
    inertia.principal.moments = pbd::Vec3::Map(moments.data());
    constexpr double rounding = 1e-9;
    if (2 * inertia.principal.moments.maxCoeff() > (1 + rounding) * inertia.principal.moments.sum())
      keys.refuse("inertia_kg_m2", "three moments, none larger than the sum of the other two");
  }
  return inertia;
}

BodyMotion read_motion(Keys& keys, const std::string& hold) {
  for (const auto* key : {"velocity_m_s", "angular_velocity_rad_s"})
    if (hold == "fixed" && keys.has(key))
      keys.refuse(key, "a velocity of a fixed body", "held = \"moving\", which keeps its velocities");
  return {keys.vector_or("velocity_m_s", pbd::Vec3::Zero()),
          keys.vector_or("angular_velocity_rad_s", pbd::Vec3::Zero())};
}

/// What touches others is the shape; `contact = false` keeps it out.
void read_body_contact(Keys& keys, Builder& builder, bool shaped, std::int64_t copies) {
  for (const auto* key : {"material", "contact", "surface_velocity_m_s"})
    if (!shaped && keys.has(key)) keys.refuse(key, "contact without a shape", "a body with a shape");
  const int material = builder.material(keys);
  for (const auto* key : {"contact", "surface_velocity_m_s"})
    if (keys.has(key)) builder.contact.mentioned = keys.where();
  if (!shaped || !keys.flag_or("contact", true)) {
    if (keys.has("surface_velocity_m_s"))
      keys.refuse("surface_velocity_m_s", "a surface that touches nothing",
                  "a body that takes part in contact");
    return;
  }
  const pbd::Vec3 surface_velocity = keys.vector_or("surface_velocity_m_s", pbd::Vec3::Zero());
  for (std::int64_t i = 0; i < copies; ++i)
    builder.contact.bodies.push_back(
        {static_cast<int>(builder.bodies.size() + i), material, surface_velocity});
}

/// The poses of a body that is led through them, from the shape's pose `placed` on; one that leaves a place
/// or a rotation out keeps that of the one before. `principal` takes the body's frame to the shape's.
std::optional<PoseCourse> read_poses(Keys& keys, const std::string& hold, Eigen::Isometry3d placed,
                                     const Eigen::Isometry3d& principal) {
  auto tables = keys.tables("pose");
  if (tables.empty()) return std::nullopt;
  if (hold != "moving")
    keys.refuse("pose", fmt::format("poses of a body with held = \"{}\"", hold), "held = \"moving\"");
  for (const auto* key : {"velocity_m_s", "angular_velocity_rad_s", "over_time", "copies"})
    if (keys.has(key)) keys.refuse(key, fmt::format("poses and {}", key), "one of them");
  const auto pose = [&]() -> BodyPose {
    const Eigen::Isometry3d body = placed * principal;
    return {body.translation(), Eigen::Quaterniond(body.linear()).normalized()};
  };
  PoseCourse course(pose());
  for (auto& table : tables) {
    const double time = table.number("time_s", Range::positive);
    if (!(time > course.last()))
      table.refuse("time_s", fmt::format("the time {} after {}", time, course.last()), "times that grow");
    placed.translation() = table.vector_or("position_m", placed.translation());
    if (table.has("rotation_rad")) placed.linear() = read_rotation(table);
    course.add(time, pose());
    table.refuse_unknown();
  }
  return course;
}

void read_rigid_body(Keys& keys, Builder& builder) {
  Copies copies(keys, builder);
  Shape shape = read_shape(keys, builder);
  const bool shaped = shape.index() != 0, endless = std::holds_alternative<HalfSpace>(shape);
  const auto hold = keys.choice_or("held", endless ? "fixed" : "free", {"free", "fixed", "moving"});
  const bool held = hold != "free";
  if (endless && hold != "fixed") keys.refuse("held", "a half space that moves", "held = \"fixed\"");
  Inertia inertia = endless  ? read_no_inertia(keys)
                    : shaped ? read_shape_inertia(keys, shape, held)
                             : read_given_inertia(keys, held);
  read_body_contact(keys, builder, shaped, copies.size());
  if (const auto* mesh = std::get_if<ClosedMesh>(&shape))
    builder.reserve(keys, "copies",
                    static_cast<double>((copies.size() - 1) * std::ssize(mesh->surface.triangles)));
  const BodyMotion motion = read_motion(keys, hold);
  if (const auto course = read_course(keys)) {
    if (copies.copied()) keys.refuse("over_time", "a course of copies", "a body of its own for each course");
    if (hold != "moving")
      keys.refuse("over_time", fmt::format("a course of a body with held = \"{}\"", hold),
                  "held = \"moving\", or a [[force]] or a [[joint]] with over_time");
    builder.script.body(builder.bodies.size(), *course);
  }

  Eigen::Isometry3d placed = Eigen::Isometry3d::Identity();  // shape's frame to world
  placed.linear() = read_rotation(keys);
  placed.translation() = keys.vector_or("position_m", pbd::Vec3::Zero());
  Eigen::Isometry3d principal = Eigen::Isometry3d::Identity();  // body to shape's frame
  principal.linear() = inertia.principal.axes.toRotationMatrix();
  principal.translation() = inertia.centre;
  if (const auto course = read_poses(keys, hold, placed, principal))
    builder.script.poses(builder.bodies.size(), *course);
  keys.refuse_unknown();
  if (held) {
    inertia.mass = pbd::infinity;
    inertia.principal.moments.setConstant(pbd::infinity);
  }
  for (std::int64_t i = 0; i < copies.size(); ++i) {
    const Eigen::Isometry3d pose = copies.moved(i, placed) * principal;
    if (!(pose.translation().cwiseAbs().maxCoeff() <= largest_number))
      throw pbd::SetupError(keys.where(), "a centre of mass beyond 1e100 m",
                            "positions up to 1e100 m in size");
    const Eigen::Quaterniond orientation = Eigen::Quaterniond(pose.linear()).normalized();
    pbd::add_body(builder.scene, pose.translation(), inertia.mass, inertia.principal.moments, orientation,
                  motion.velocity, orientation.conjugate() * motion.angular_velocity);
    builder.bodies.push_back({copies.name(i), shape, principal.inverse()});
  }
}

}  // namespace

void read_rigid_bodies(Keys& root, Builder& builder) {
  for (auto& keys : root.tables("rigid_body")) read_rigid_body(keys, builder);
}

void read_gyroscopic(Keys& root, Builder& builder) {
  auto keys = root.table("gyroscopic");
  if (!keys) return;
  if (builder.bodies.empty())
    throw pbd::SetupError(keys->where(), "a gyroscopic torque without a rigid body", "a [[rigid_body]]");
  builder.add(keys->line(),
              pbd::Gyroscopic{keys->choice_or("form", "implicit", {"implicit", "explicit"}) == "implicit"});
  keys->refuse_unknown();
}

void read_torques(Keys& root, Builder& builder) {
  auto tables = root.tables("torque");
  if (tables.empty()) return;
  pbd::ExternalTorque effect;
  for (auto& keys : tables) {
    effect.body.push_back(builder.body(keys, "body"));
    if (const auto course = read_course(keys)) builder.script.torque(effect.body.size() - 1, *course);
    effect.torque.push_back(keys.vector("torque_n_m"));
    keys.refuse_unknown();
  }
  builder.add(tables[0].line(), std::move(effect));
}

}  // namespace pbdcheck
