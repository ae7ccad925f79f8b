// Small things that several tests share.
#pragma once

#include <cmath>
#include <numbers>

#include "mesh.h"
#include "scenes/standard.h"
#include "step/step.h"

namespace pbd::test {

using pbdcheck::cantilever;
using pbdcheck::chain;
using pbdcheck::gravity;

inline Method direct_method(double tolerance = 1e-13) {
  Method method;
  method.relaxation = "direct";
  method.tolerance = tolerance;
  return method;
}

/// A step by a fresh workspace.
inline Report one_step(const Scene& scene, const Method& method, double h, State& state,
                       const Observer& observer = {}) {
  Workspace workspace(scene, method);
  return step(workspace, h, state, observer);
}

/// Bob on a massless hard link, released horizontally at rest.
inline Scene pendulum() {
  return pbdcheck::pendulum(std::numbers::pi / 2, 0);
}

/// State after `steps` steps of h seconds with the direct relaxation at a tight tolerance.
inline State advanced(const Scene& scene, double h, int steps) {
  const Method method = direct_method(1e-12);
  Workspace workspace(scene, method);
  State state = scene.initial;
  for (int k = 0; k < steps; ++k) step(workspace, h, state);
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
