// Soft bodies that are twisted, thrown and pulled.
#include <numbers>

#include <fmt/format.h>

#include "studies/robustness/contact_cases.h"
#include "studies/robustness/soft_parts.h"

namespace pbdcheck {
namespace {

using namespace pbd;

/// Holds the nodes at both ends along x of what is `length` (m) long by two bodies that turn against each
/// other, 72 degrees a second (li2020incremental).
void twist_ends(Scene& scene, double length) {
  constexpr double rate = 0.4 * std::numbers::pi;
  Attachment held;
  const int nodes = scene.nodes();
  for (const double end : {0.0, length}) {
    const Vec3 spin((end > 0 ? 1 : -1) * rate, 0, 0);
    const int body = add_body(scene, Vec3(end, 0, 0), infinity, Vec3::Constant(infinity),
                              Eigen::Quaterniond::Identity(), Vec3::Zero(), spin);
    for (int node = 0; node < nodes; ++node) {
      const Vec3 from_end = scene.initial.x.col(node) - Vec3(end, 0, 0);
      if (std::abs(from_end.x()) > 1e-9 * length) continue;
      held.body.push_back(body);
      held.node.push_back(node);
      held.point.push_back(from_end);
      held.compliance.push_back(0);
    }
  }
  scene.effects.emplace_back(std::move(held));
}

ContactCase twisted(std::string name, Scene scene, double h, double duration, double size) {
  twist_ends(scene, 1);
  ContactCase made{std::move(name), std::move(scene), h, duration, size};
  made.settles = false;
  return made;
}

/// Two rods of 1 m and 1e4 Pa are wound around each other.
ContactCase twisted_rods(int across, double h, double duration) {
  Scene scene = BodyScene({.friction = 0.1}, 0).finish();
  constexpr double thick = 0.1;
  for (const double y : {-0.06, 0.06})
    add_soft(scene,
             kuhn_grid({8 * across, across, across}, {1, thick, thick}, {0, y - thick / 2, -thick / 2}), 1e4);
  return twisted(fmt::format("two rods wound around each other, h = {:g} s", h), std::move(scene), h,
                 duration, thick);
}

/// A mat of 1 x 0.5 m and 2e4 Pa, twisted until it touches itself.
ContactCase twisted_mat(int cells, double duration) {
  Scene scene = BodyScene({.friction = 0.1}, 0).finish();
  constexpr double thick = 0.02;
  add_soft(scene, kuhn_grid({2 * cells, cells, 1}, {1, 0.5, thick}, {0, -0.25, -thick / 2}), 2e4);
  return twisted("mat twisted by its ends", std::move(scene), 0.04, duration, thick);
}

/// A golf ball at 67 m/s against a wall of 2 mm: 1e7 Pa (li2020incremental).
ContactCase golf_ball(double h, double duration, double away, bool continuous, int cells) {
  constexpr double radius = 0.0214, wall = 0.002;
  BodyScene build({.friction = 0.5}, 0);
  build.contact().continuous = continuous;
  build.contact().surfaces_touch = !continuous;  // far flights make neighbours of all its nodes
  build.fixed(Box{Vec3(wall, 1, 1)}, {Vec3(away + radius + half_thickness + wall / 2, 0, 0)});
  Scene scene = build.finish();
  add_touching_solid(scene, soft_ball(cells, radius, Vec3::Zero()), 1150, {1e7, 0.45}, Strain::corotational);
  for (int node = 1; node < scene.nodes(); ++node) scene.initial.v.col(node) = Vec3(67, 0, 0);
  const Contact& contact = *contact_of(scene);
  ContactCase made{
      fmt::format("golf ball at 67 m/s, h = {:.2g} s{}", h, continuous ? ", not against itself" : ""), scene,
      h, duration, 2 * radius};
  made.settles = false;
  Core skin = core_of(contact.triangle);
  skin.radius = half_thickness;
  made.apart_for_ever = {{{skin, core_of(contact.collider[0], 1)},
                          {core_of(contact.triangle), core_of(contact.collider[0], core_share)}}};
  return made;
}

/// A ball of 7e4 Pa falls on the ground at 5 m/s.
ContactCase squishy_ball() {
  BodyScene build({.friction = 0.5});
  build.ground();
  Scene scene = build.finish();
  constexpr double radius = 0.1;
  add_soft(scene, soft_ball(4, radius, {0, 0, radius + 0.01}), 7e4);
  for (int node = 1; node < scene.nodes(); ++node) scene.initial.v.col(node) = Vec3(0, 0, -5);
  ContactCase made{"squishy ball at 5 m/s", std::move(scene), 1e-3, 0.2, 2 * radius};
  made.settles = false;
  return made;
}

/// A rod of 0.1 m and 1e5 Pa that is held at its upper end leans on a plate, which pulls at its lower one.
ContactCase pulled_rod(double speed, int across) {
  BodyScene build({.friction = 0.35});
  build.ground();
  build.contact().collider.back().surface_velocity = Vec3(speed, 0, 0);
  Scene scene = build.finish();
  constexpr double length = 0.1, thick = 0.01;
  TetMesh mesh =
      kuhn_grid({8 * across, across, across}, {length, thick, thick}, {-length, -thick / 2, -thick / 2});
  const auto held = (mesh.x.row(0).array() == -length).eval();
  mesh.x = about_y(std::numbers::pi / 4).toRotationMatrix() * mesh.x;
  mesh.x.row(2).array() += half_thickness - mesh.x.row(2).minCoeff();
  const int first = add_soft(scene, mesh, 1e5);
  for (Eigen::Index i = 0; i < held.size(); ++i)
    if (held[i]) scene.mass[static_cast<std::size_t>(first + i)] = infinity;
  ContactCase made{fmt::format("rod on a plate that moves at {:g} m/s", speed), std::move(scene), 1e-3, 0.5,
                   thick};
  made.settles = false;
  return made;
}

}  // namespace

std::vector<ContactCase> driven_soft_cases(bool full) {
  std::vector<ContactCase> all;
  for (const double h : {0.002, 0.005, 0.01, 0.025, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0})
    if (full || h == 0.025) all.push_back(twisted_rods(1, h, full ? 5 : 1.5));
  all.push_back(twisted_mat(full ? 4 : 3, full ? 5 : 2));
  all.push_back(golf_ball(2e-5, 1e-3, 1e-3, false, full ? 4 : 3));
  if (full) all.push_back(golf_ball(video_frame, 0.1, 0.3, true, 3));
  if (full) all.push_back(squishy_ball());
  for (const double speed : {0.05, 0.1})
    if (full || speed == 0.1) all.push_back(pulled_rod(speed, full ? 2 : 1));
  return all;
}

}  // namespace pbdcheck
