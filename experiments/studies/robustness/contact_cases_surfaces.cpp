// Bodies with spikes, wedges, holes, cliffs and inner edges, as hulls and meshes of triangles (Erleben's
// ten); thin walls, a narrow tunnel, a lever (of Rigid-IPC).
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "polyhedron.h"
#include "scenes/body_shapes.h"
#include "studies/robustness/contact_cases.h"
#include "studies/robustness/relief.h"

namespace pbdcheck {
namespace {

using namespace pbd;

using std::numbers::pi;

Pair pair_of(const Contact& contact, std::size_t first, std::size_t second) {
  const auto both = [&](double share) {
    return std::array{core_of(contact.collider[first], share), core_of(contact.collider[second], share)};
  };
  return {both(1), both(core_share)};
}

struct Falling {
  const char* name;
  bool wedge;
  double turn;   // rad, about the vertical
  double depth;  // m
};
struct Below {
  const char* name;
  bool along;
  double sign;
};

/// Slim ones fall onto the tip or into the bottom, blunt ones are as steep as what is cut into the block.
constexpr double slim = 0.3, blunt = 0.1 * relief / slope;
constexpr Falling spike{"spike", false, 0, slim}, wedge{"wedge", true, 0, slim},
    across{"wedge across", true, pi / 2, slim}, blunt_spike{"blunt spike", false, 0, blunt},
    blunt_wedge{"blunt wedge", true, 0, blunt};
constexpr Below peak{"a spike", false, 1}, ridge{"a ridge", true, 1}, hole{"a hole", false, -1},
    groove{"a groove", true, -1};

ContactCase dropped(const Falling& falling, const Below& below) {
  BodyScene build({.friction = 0.5});
  build.fixed(with_relief(below.along, below.sign), {Vec3(0, 0, -0.5)});
  const double touching = below.sign * relief + 2 * falling.depth / 3;
  build.hull(
      pointed(falling.wedge, falling.depth), 1000,
      {Vec3(0, 0, touching + 0.15), Eigen::Quaterniond(Eigen::AngleAxisd(falling.turn, Vec3::UnitZ()))});
  ContactCase made{fmt::format("{} on {}", falling.name, below.name), build.finish(), video_frame, 2,
                   falling.depth};
  made.settles = false;
  made.apart_for_ever = {pair_of(build.contact(), 0, 1)};
  return made;
}

/// The body is the mesh: a block with a hole is dropped upside down on a spike.
ContactCase hole_on_spike() {
  BodyScene build({.friction = 0.5});
  build.ground();
  build.fixed(pointed(false, slim), {Vec3(0, 0, 0.1), Eigen::Quaterniond(0, 1, 0, 0)});
  build.mesh(with_relief(false, -1), 1000, {Vec3(0, 0, 0.55), Eigen::Quaterniond(0, 1, 0, 0)});
  ContactCase made{"block with a hole on a spike", build.finish(), video_frame, 1, slim};
  made.settles = false;
  made.apart_for_ever = {pair_of(build.contact(), 2, 1)};
  return made;
}

/// A box over the edge of a block, its centre `inside` (m) from the edge.
ContactCase on_cliff(double inside) {
  BodyScene build({.friction = 0.5});
  build.fixed(plate(4, Vec3::Ones()), {Vec3(0, 0, -0.5)});
  build.box(Vec3(0.2, 0.2, 0.1), 4, {Vec3(0.5 - inside, 0.07, 0.05)});
  ContactCase made{fmt::format("box at a cliff, its centre {:+g} m inside", inside), build.finish(),
                   video_frame, 2, 0.1};
  made.settles = made.stays = inside > 0;
  made.falls = inside < 0;
  if (inside > 0) made.reaction = 4 * gravity;
  return made;
}

/// Way (m) of what slides in at `speed` and is slowed by mu g, in steps of implicit Euler.
double sliding_way(double speed, double friction, double h, std::int64_t steps) {
  double way = 0;
  for (std::int64_t k = 1; k <= steps; ++k)
    way += h * std::max(0.0, speed - friction * gravity * h * static_cast<double>(k));
  return way;
}

/// A box, or a ball, slides over the inner edges of a flat mesh as over a plane.
ContactCase over_inner_edges(int cells, double friction, bool ball) {
  constexpr double speed = 2;
  const Vec3 heading(std::cos(0.3), std::sin(0.3), 0);
  BodyScene build({.friction = friction});
  build.fixed(plate(cells, Vec3(4, 4, 1)), {Vec3(0, 0, -0.5)});
  const Placing at{Vec3(-1.013, -0.507, ball ? 0.1 : 0.05), Eigen::Quaterniond::Identity(), speed * heading};
  ball ? build.ball(0.1, 4, at) : build.box(Vec3(0.2, 0.2, 0.1), 4, at);
  ContactCase made{
      fmt::format("{} over the inner edges of a mesh, mu = {:g}", ball ? "ball" : "box", friction),
      build.finish(), 0.01, 1, 0.1};
  made.settles = friction > 0;
  made.lift = 1e-9;
  made.missed = [=, start = Vec3(at.position)](const State& end, double h, std::int64_t steps) {
    const Vec3 exact = start + sliding_way(speed, friction, h, steps) * heading;
    return (end.x.col(1) - exact).norm() / (exact - start).norm();
  };
  return made;
}

/// Box2D's HighMassRatio3: 400:1 dropped on two small boxes, on triangles.
ContactCase dropped_on_triangles() {
  BodyScene build({.friction = 0.5});
  build.fixed(plate(12, Vec3(24, 24, 2)), {Vec3(0, 0, -1)});
  for (const double x : {-9.0, 9.0}) build.box(Vec3::Constant(1), 1, {Vec3(x, 0, 0.5)});
  build.box(Vec3(20, 4, 20), 400, {Vec3(0, 0, 11 + 15)});
  return {"box of 400:1 dropped on two small ones on triangles", build.finish(), video_frame, 4, 1};
}

constexpr double cube = 0.1, wall = 0.002, fast = 25;  // m, m, m/s

/// A cube flies against the first of three thin walls and ends at it.
ContactCase thin_walls(bool meshes) {
  BodyScene build({.friction = 0.5}, 0);
  build.contact().continuous = true;
  const Vec3 size(wall, 1, 1);
  for (const double x : {1.0, 1.3, 1.6}) {
    const Shape box = Box{size}, mesh = ClosedMesh(box_surface(size));
    build.fixed(meshes ? mesh : box, {Vec3(x, 0, 0)});
  }
  build.box(Vec3::Constant(cube), 1, {Vec3::Zero(), Eigen::Quaterniond::Identity(), Vec3(fast, 0, 0)});
  ContactCase made{fmt::format("cube at 25 m/s against walls of 2 mm, {}", meshes ? "meshes" : "boxes"),
                   build.finish(), video_frame, 0.2, cube};
  made.settles = false;
  made.missed = [](const State& end, double, std::int64_t) {
    return (end.x.col(3) - Vec3(1 - (wall + cube) / 2, 0, 0)).norm() / cube;
  };
  for (const std::size_t each : {0U, 1U, 2U})
    made.apart_for_ever.push_back(pair_of(build.contact(), 3, each));
  return made;
}

/// A cube flies through a tunnel with a millimetre of play on each side and touches nothing.
ContactCase tunnel() {
  BodyScene build({.friction = 0.5}, 0);
  build.contact().continuous = true;
  constexpr double off = (cube + wall) / 2 + 0.05;
  for (const double side : {-1.0, 1.0}) {
    build.fixed(Box{Vec3(2, 1, 0.1)}, {Vec3(2, 0, side * off)});
    build.fixed(Box{Vec3(2, 0.1, 1)}, {Vec3(2, side * off, 0)});
  }
  build.box(Vec3::Constant(cube), 1, {Vec3::Zero(), Eigen::Quaterniond::Identity(), Vec3(fast, 0, 0)});
  ContactCase made{"cube at 25 m/s through a tunnel", build.finish(), video_frame, 0.2, cube};
  made.settles = false;
  made.missed = [](const State& end, double h, std::int64_t steps) {
    const double way = fast * h * static_cast<double>(steps);
    return (end.x.col(4) - Vec3(way, 0, 0)).norm() / way;
  };
  return made;
}

/// A beam over a block with arms of 15:1; all centres together are `beyond` (m) past the block's edge.
ContactCase lever(double beyond) {
  constexpr double half = 0.05, thickness = 0.05, light = 500, heavy = 7680, arm = 3;
  BodyScene build({.friction = 0.5});
  build.fixed(Box{Vec3(2 * half, 1, 1)}, {Vec3(0, 0, -0.5)});
  const double beam = light * 3.6 * 0.4 * thickness, weight = heavy * 0.4 * 0.4 * 0.4;
  const double centre = half + beyond;
  const double small = (weight * (arm / 15 + centre) - beam * (1.4 - centre)) / (arm - centre);
  build.box(Vec3(3.6, 0.4, thickness), beam, {Vec3(1.4, 0, thickness / 2)});
  build.box(Vec3::Constant(0.4), weight, {Vec3(-arm / 15, 0, thickness + 0.2)});
  build.box(Vec3::Constant(0.2), small, {Vec3(arm, 0, thickness + 0.1)});
  ContactCase made{fmt::format("lever, its centre {:+g} m past the edge", beyond), build.finish(), 0.01, 2,
                   thickness};
  made.settles = made.stays = beyond < 0;
  made.falls = beyond > 0;
  if (beyond < 0) made.reaction = (beam + weight + small) * gravity;
  return made;
}

/// The hull of two circles, each through the other's centre, rolls on its one curved face.
ContactCase oloid() {
  constexpr int sides = 24;
  constexpr double radius = 0.1;
  Points x(3, 2 * sides);
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * pi * k / sides, c = radius * std::cos(angle), s = radius * std::sin(angle);
    x.col(k) = Vec3(c - radius / 2, s, 0);
    x.col(sides + k) = Vec3(c + radius / 2, 0, s);
  }
  BodyScene build({.friction = 0.5});
  build.ground();
  build.hull(ConvexHull(convex_hull(x)), 1000, {Vec3(0, 0, radius)});
  ContactCase made{"oloid", build.finish(), 0.01, 2, radius};
  made.settles = false;
  return made;
}

}  // namespace

std::vector<ContactCase> surface_cases(bool full) {
  std::vector<ContactCase> all;
  for (const auto& [falling, below] :
       {std::pair{spike, peak}, {across, ridge}, {blunt_spike, hole}, {blunt_wedge, groove}})
    all.push_back(dropped(falling, below));
  if (full)
    for (const auto& [falling, below] : {std::pair{spike, ridge},
                                         {spike, hole},
                                         {spike, groove},
                                         {wedge, peak},
                                         {wedge, ridge},
                                         {wedge, hole},
                                         {wedge, groove},
                                         {across, groove}})
      all.push_back(dropped(falling, below));
  all.push_back(hole_on_spike());
  for (const double inside : {0.01, -0.01}) all.push_back(on_cliff(inside));
  all.push_back(over_inner_edges(full ? 32 : 16, 0.5, false));
  all.push_back(over_inner_edges(full ? 32 : 16, 0, true));
  all.push_back(dropped_on_triangles());
  for (const bool meshes : {false, true}) all.push_back(thin_walls(meshes));
  all.push_back(tunnel());
  for (const double beyond : {-0.005, 0.005}) all.push_back(lever(beyond));
  all.push_back(oloid());
  return all;
}

}  // namespace pbdcheck
