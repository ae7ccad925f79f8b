// Scenes of nodes that the judges are tried on. SI units.
#pragma once

#include <cmath>

#include "mesh.h"
#include "scene.h"

namespace pbd::test {

/// Chain of total length 1 m swinging about a fixed node, 0.1 kg a node, the last one `ratio` times as heavy.
inline Scene swinging_chain(int links, double ratio) {
  const Vec3 along(std::sin(1.0), 0, -std::cos(1.0)), across(std::cos(1.0), 0, std::sin(1.0));
  Scene scene;
  Distance distance;
  add_node(scene, Vec3::Zero(), infinity);
  for (int i = 1; i <= links; ++i) {
    const double s = double(i) / links;
    add_node(scene, s * along, i == links ? 0.1 * ratio : 0.1, 2 * s * across);
    distance.node.push_back({i - 1, i});
    distance.rest_length.push_back(1.0 / links);
    distance.compliance.push_back(0);
  }
  scene.effects = {Gravity{}, distance};
  return scene;
}

inline Scene cantilever(int n, double young, double poisson, Strain strain) {
  Scene scene;
  add_solid(scene, kuhn_grid({n, n / 4, n / 4}, Vec3(1, 0.25, 0.25)), 1000, {young, poisson}, strain);
  for (int i = 0; i < scene.nodes(); ++i)
    if (scene.initial.x(0, i) == 0) scene.mass[i] = infinity;
  scene.effects.emplace_back(Gravity{});
  return scene;
}

/// Largest difference of a and b over the largest displacement.
inline double relative(const Points& a, const Points& b, const Points& start) {
  return (a - b).cwiseAbs().maxCoeff() / (a - start).cwiseAbs().maxCoeff();
}

}  // namespace pbd::test
