#include "scenes/standard.h"

#include <cmath>

namespace pbdcheck {

using namespace pbd;

Scene pendulum(double angle, double rate) {
  Scene scene;
  add_node(scene, Vec3::Zero(), infinity);
  add_node(scene, Vec3(std::sin(angle), 0, -std::cos(angle)), 1,
           rate * Vec3(std::cos(angle), 0, std::sin(angle)));
  scene.effects.emplace_back(Gravity{});
  scene.effects.emplace_back(Distance{.node = {{0, 1}}, .rest_length = {1}, .compliance = {0}});
  return scene;
}

Scene chain(int links, double ratio, bool free) {
  Scene scene;
  Distance effect;
  for (int i = 0; i <= links; ++i) {
    const double mass = i == links ? 0.1 * ratio : 0.1;
    add_node(scene, Vec3(static_cast<double>(i) / links, 0, 0), i == 0 && !free ? infinity : mass);
    if (i == 0) continue;
    effect.node.push_back({i - 1, i});
    effect.rest_length.push_back(1.0 / links);
    effect.compliance.push_back(0);
  }
  scene.effects.emplace_back(Gravity{});
  scene.effects.emplace_back(std::move(effect));
  return scene;
}

Scene cloth(int cells, bool links_only) {
  const TriangleMesh mesh = grid_sheet({cells, cells}, {1, 1});
  Scene scene;
  const int first = add_sheet_nodes(scene, mesh, 0.2);
  scene.effects.emplace_back(Gravity{});
  scene.effects.emplace_back(sheet_links(mesh, first, 1e-5));
  if (!links_only) scene.effects.emplace_back(sheet_bending(mesh, first, 1e2));
  clamp_smallest_x(scene);
  return scene;
}

Scene clamped_solid(const TetMesh& mesh, const Material& material, Strain strain) {
  Scene scene;
  scene.effects.emplace_back(Gravity{});
  add_solid(scene, mesh, 1000, material, strain);
  clamp_smallest_x(scene);
  return scene;
}

Scene clamped_cube(int tets) {
  const int cells = std::max(1, static_cast<int>(std::lround(std::cbrt(tets / 6.0))));
  return clamped_solid(kuhn_grid({cells, cells, cells}, Vec3::Ones()), {1e6, 0.3}, Strain::corotational);
}

Scene cantilever(int cells, const Material& material, Strain strain) {
  return clamped_solid(kuhn_grid({cells, cells / 4, cells / 4}, Vec3(1, 0.25, 0.25)), material, strain);
}

ExternalForce nodal_force(const Points& loads) {
  ExternalForce force;
  for (int node = 0; node < loads.cols(); ++node)
    if (!loads.col(node).isZero(0)) {
      force.node.push_back(node);
      force.force.emplace_back(loads.col(node));
    }
  return force;
}

void clamp_smallest_x(Scene& scene) {
  const double smallest = scene.initial.x.row(0).minCoeff();
  const double extent = scene.initial.x.row(0).maxCoeff() - smallest;
  constexpr double rounding = 1e-9;  // of the extent
  for (int node = 0; node < scene.nodes(); ++node)
    if (scene.initial.x(0, node) - smallest <= rounding * extent)
      scene.mass[static_cast<std::size_t>(node)] = infinity;
}

}  // namespace pbdcheck
