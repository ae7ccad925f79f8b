// Small scenes that several tests share.
#pragma once

#include <cmath>

#include "mesh.h"
#include "step.h"

namespace pbd::test {

/// Straight chain of `links` hard links over 1 m along `direction`, 0.1 kg a node, the last one 0.1 * ratio;
/// the first node is fixed unless `free`.
inline Scene chain(int links, double ratio = 1, bool free = false, const Vec3& direction = Vec3::UnitX()) {
  Scene scene;
  Distance effect;
  const double length = 1.0 / links;
  for (int i = 0; i <= links; ++i) {
    const bool fixed = i == 0 && !free;
    add_node(scene, i * length * direction, fixed ? infinity : i == links ? 0.1 * ratio : 0.1);
    if (i == 0) continue;
    effect.node.push_back({i - 1, i});
    effect.rest_length.push_back(length);
    effect.compliance.push_back(0);
  }
  scene.effects.emplace_back(Gravity{});
  scene.effects.emplace_back(std::move(effect));
  return scene;
}

/// Cantilever of 1 x 1/4 x 1/4 m in cells x cells/4 x cells/4 bricks, clamped at x = 0.
inline Scene cantilever(int cells, const Material& material, Strain strain) {
  Scene scene;
  scene.effects.emplace_back(Gravity{});
  add_solid(scene, kuhn_grid({cells, cells / 4, cells / 4}, Vec3(1, 0.25, 0.25)), 1000, material, strain);
  for (int node = 0; node < scene.nodes(); ++node)
    if (scene.initial.x(0, node) == 0) scene.mass[static_cast<std::size_t>(node)] = infinity;
  return scene;
}

/// State after `steps` steps of h seconds with the direct relaxation at a tight tolerance.
inline State advanced(const Scene& scene, double h, int steps) {
  Method method;
  method.relaxation = "direct";
  method.tolerance = 1e-12;
  Workspace workspace(scene, method);
  State state = scene.initial;
  for (int k = 0; k < steps; ++k) step(scene, method, h, state, workspace);
  return state;
}

/// Total kinetic momentum, kg m/s, of the nodes that can move.
inline Vec3 momentum(const Scene& scene, const State& state) {
  Vec3 total = Vec3::Zero();
  for (int node = 0; node < scene.nodes(); ++node)
    if (const double mass = scene.mass[static_cast<std::size_t>(node)]; std::isfinite(mass))
      total += mass * state.v.col(node);
  return total;
}

}  // namespace pbd::test
