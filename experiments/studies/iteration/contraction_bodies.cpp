#include "studies/iteration/contraction_bodies.h"

#include <cmath>
#include <tuple>

#include "mesh.h"
#include "scenes/standard.h"

namespace pbdcheck {
namespace {

using namespace pbd;

Scene links(double stiffness) {
  Scene scene;
  Distance effect;
  for (int i = 0; i <= 3; ++i) {
    add_node(scene, Vec3(i, 0, 0), i == 0 ? infinity : 1);
    if (i == 0) continue;
    effect.node.push_back({i - 1, i});
    effect.rest_length.push_back(1);
    effect.compliance.push_back(1 / stiffness);
  }
  scene.effects = {effect};
  return scene;
}

Scene hinge(double stiffness) {
  Scene scene;
  for (const auto& [x, y, mass] :
       {std::tuple{0.0, 0.0, infinity}, {0.0, 1.0, infinity}, {-1.0, 0.5, infinity}, {1.0, 0.5, 1.0}})
    add_node(scene, Vec3(x, y, 0), mass);
  scene.effects = {Bending{.node = {{0, 1, 2, 3}}, .rest_angle = {0}, .compliance = {1 / stiffness}}};
  return scene;
}

Scene sheet(double young) {
  const TriangleMesh mesh = grid_sheet({2, 1}, {1, 0.5});
  Scene scene;
  const int first = add_sheet_nodes(scene, mesh, 1);
  scene.effects = {sheet_strain(mesh, first, {young, 0.3}, 1e-3)};
  clamp_smallest_x(scene);
  return scene;
}

template <Strain strain>
Scene bar(double young) {
  Scene scene;
  add_solid(scene, kuhn_grid({2, 1, 1}, Vec3(1, 0.5, 0.5)), 1000, {young, 0.3}, strain);
  clamp_smallest_x(scene);
  return scene;
}

Scene held(double stiffness) {
  Scene scene;
  add_node(scene, Vec3::Zero(), 1);
  scene.effects = {Anchor{.node = {0}, .target = {Vec3(-1, 0, 0)}, .compliance = {1 / stiffness}}};
  return scene;
}

/// Three rods of 1 m and 1 kg along x, the first on the ground: balls of this stiffness (N/m; inf: hard), or
/// hard hinges about z whose axes are held with it (N m/rad).
template <bool hinges>
Scene rods(double stiffness) {
  Scene scene;
  add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
  PointJoint balls;
  AxisJoint axes;
  const double compliance = 1 / stiffness;
  for (int i = 0; i < 3; ++i) {
    const int rod = add_body(scene, Vec3(i + 0.5, 0, 0), 1, Vec3(0.01, 1.0 / 12, 1.0 / 12));
    balls.body.push_back({rod - 1, rod});
    balls.point.push_back({Vec3(i == 0 ? 0 : 0.5, 0, 0), Vec3(-0.5, 0, 0)});
    balls.compliance.push_back(hinges ? 0 : compliance);
    axes.body.push_back({rod - 1, rod});
    axes.axis.push_back({Vec3::UnitZ(), Vec3::UnitZ()});
    axes.compliance.push_back(compliance);
  }
  scene.effects = {balls};
  if (hinges) scene.effects.emplace_back(axes);
  return scene;
}

}  // namespace

std::vector<OneEffectBody> one_effect_bodies() {
  const Vec3 along = Vec3::UnitX(), across = Vec3::UnitZ();
  const std::vector<double> solid_young{1e5, 1e6, 1e7}, solid_loads{-500, 2000, 8000, 32000};
  return {{"distance", "", "N/m", {1e3, 1e4, 1e5}, {-50, 50, 250, 1000}, links, along},
          {"bending", "", "N m/rad", {1e2, 1e3, 1e4}, {-50, 200, 800, 2800}, hinge, across},
          {"triangle_strain", "", "Pa", {1e6, 1e7, 1e8}, {-2, 4, 20, 80}, sheet, along},
          {"tet_strain", "green", "Pa", solid_young, solid_loads, bar<Strain::green>, along},
          {"tet_strain", "corotational", "Pa", solid_young, solid_loads, bar<Strain::corotational>, along},
          {"anchor", "", "N/m", {1e3, 1e4, 1e5}, {-50, 50, 250, 1000}, held, along},
          {"point_joint", "", "N/m", {1e4, 1e5, infinity}, {-50, 50, 250, 1000}, rods<false>, along},
          {"axis_joint", "", "N m/rad", {1e2, 1e3, 1e4}, {-50, 50, 250, 1000}, rods<true>, along}};
}

void load_and_stir(Scene& scene, const Vec3& load) {
  constexpr double speed = 0.1;  // m/s
  const auto x = scene.initial.x.row(0);
  ExternalForce force;
  for (int node = 0; node < scene.nodes(); ++node) {
    if (!std::isfinite(scene.mass[static_cast<std::size_t>(node)])) continue;
    for (int axis = 0; axis < 3; ++axis) scene.initial.v(axis, node) = speed * std::sin(3 * node + axis + 1);
    if (x[node] == x.maxCoeff()) force.node.push_back(node);
  }
  force.force.assign(force.node.size(), load / static_cast<double>(force.node.size()));
  scene.effects.emplace_back(force);
}

}  // namespace pbdcheck
