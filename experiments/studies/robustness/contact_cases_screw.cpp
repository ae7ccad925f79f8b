// A wing nut on a threaded rod, both as meshes: a closed surface around another one, with hundreds of places
// where they may touch.
#include <cmath>
#include <functional>
#include <numbers>

#include <fmt/format.h>

#include "harness/probes.h"
#include "studies/robustness/contact_cases.h"

namespace pbdcheck {
namespace {

using namespace pbd;

using std::numbers::pi;

constexpr int sides = 16;                           // of a turn
constexpr double pitch = 0.02, core_radius = 0.05;  // m
constexpr double depth = 0.012, play = 0.003;       // m, of the thread and of the nut about the rod

/// Depth of the thread (m) at a side and a level of pitch/sides: the sum of both tells the helix.
double thread(int side, int level) {
  const int turn = ((level - side) % sides + sides) % sides;
  return depth * (1 - std::abs(2.0 * turn / sides - 1));
}

using Radius = std::function<double(int side, int level)>;

/// Adds a wall of `levels` rings about z, seen from outside or from inside; its diagonals run along the
/// helix. Returns its first node.
int add_wall(TriangleMesh& mesh, int levels, const Radius& radius, bool outside) {
  const auto first = static_cast<int>(mesh.x.cols());
  mesh.x.conservativeResize(3, first + sides * (levels + 1));
  for (int level = 0; level <= levels; ++level)
    for (int side = 0; side < sides; ++side) {
      const double angle = 2 * pi * side / sides, r = radius(side, level);
      mesh.x.col(first + level * sides + side) =
          Vec3(r * std::cos(angle), r * std::sin(angle), (level - 0.5 * levels) * pitch / sides);
    }
  for (int level = 0; level < levels; ++level)
    for (int side = 0; side < sides; ++side) {
      const int a = first + level * sides + side, b = first + level * sides + (side + 1) % sides;
      const int c = b + sides, d = a + sides;
      if (outside) mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
      if (!outside) mesh.triangles.insert(mesh.triangles.end(), {{a, c, b}, {a, d, c}});
    }
  return first;
}

ClosedMesh threaded_rod(int turns) {
  TriangleMesh mesh{Points(3, 0), {}};
  const int levels = turns * sides, top = levels * sides;
  add_wall(
      mesh, levels, [](int side, int level) { return core_radius + thread(side, level); }, true);
  const auto below = static_cast<int>(mesh.x.cols());
  mesh.x.conservativeResize(3, below + 2);
  mesh.x.rightCols<2>() << 0, 0, 0, 0, -0.5 * turns * pitch, 0.5 * turns * pitch;
  for (int side = 0; side < sides; ++side) {
    const int next = (side + 1) % sides;
    mesh.triangles.insert(mesh.triangles.end(), {{below, next, side}, {below + 1, top + side, top + next}});
  }
  return ClosedMesh(std::move(mesh));
}

ClosedMesh wing_nut(int turns) {
  constexpr double body = 0.075, wing = 0.14;  // m
  TriangleMesh mesh{Points(3, 0), {}};
  const int levels = turns * sides, top = levels * sides;
  add_wall(
      mesh, levels, [](int side, int level) { return core_radius + play + thread(side, level); }, false);
  const int outer = add_wall(
      mesh, levels, [](int side, int) { return side % (sides / 2) == 0 ? wing : body; }, true);
  for (int side = 0; side < sides; ++side) {
    const int next = (side + 1) % sides;
    mesh.triangles.insert(mesh.triangles.end(), {{side, next, outer + next},
                                                 {side, outer + next, outer + side},
                                                 {top + side, outer + top + next, top + next},
                                                 {top + side, outer + top + side, outer + top + next}});
  }
  return ClosedMesh(std::move(mesh));
}

/// Turns about -z by which `state` has turned a body from its start, 0 to 1.
double turns_down(const Scene& scene, const State& state, std::size_t body) {
  const Eigen::Quaterniond turned = state.orientation[body] * scene.initial.orientation[body].conjugate();
  const double turns = -std::atan2(turned.z(), turned.w()) / pi;
  return turns - std::floor(turns);
}

}  // namespace

std::vector<ContactCase> screw_cases(bool full) {
  std::vector<ContactCase> all;
  for (const double friction : {0.0, 0.5}) {
    if (!full && friction == 0) continue;  // for its time
    BodyScene build({.friction = friction});
    build.fixed(threaded_rod(full ? 6 : 3), {Vec3::Zero()});
    const int nut = build.mesh(wing_nut(full ? 2 : 1), 1000, {Vec3::Zero()});
    Scene scene = build.finish();
    scene.initial.v.col(nut) = Vec3(0, 0, -pitch / 2);
    scene.initial.spin.col(nut) = scene.initial.orientation[1].conjugate() * Vec3(0, 0, -pi);
    ContactCase made{fmt::format("wing nut spun at 180 degrees a second, mu = {:g}", friction), scene, 0.01,
                     full ? 1 : 0.2, depth};
    // The pitch's angle is far below that of friction: the nut locks itself.
    made.settles = friction > 0;
    made.reaction = friction > 0 ? finite_mass(scene) * gravity : -1;
    // Without friction it goes down as it turns, in a second by less than a turn. From the middle of its play
    // the flanks let it go by the radius it has to spare, and what the sides of a turn are flat by, over
    // their slope.
    if (friction == 0)
      made.missed = [scene](const State& end, double, std::int64_t) {
        return std::abs(scene.initial.x(2, 1) - end.x(2, 1) - pitch * turns_down(scene, end, 1));
      };
    made.exact_to = pitch / 2 / depth * (play + (core_radius + play + depth) * (1 - std::cos(pi / sides)));
    all.push_back(std::move(made));
  }
  return all;
}

}  // namespace pbdcheck
