// Four irregular nodes with one effect on them.
#pragma once

#include "scene.h"

namespace pbd::test {

/// Four irregular nodes carrying one effect.
inline Scene scene_with(const Effect& effect) {
  Scene scene;
  add_node(scene, Vec3(0.1, -0.2, 0.05), 1);
  add_node(scene, Vec3(1.2, 0.1, -0.1), 2);
  add_node(scene, Vec3(0.2, 0.9, 0.3), 0.5);
  add_node(scene, Vec3(-0.1, 0.3, 1.1), 1.5);
  scene.effects = {effect};
  return scene;
}

inline Eigen::Matrix<double, 3, 4> rest_tet() {
  Eigen::Matrix<double, 3, 4> rest;
  rest << 0, 1, 0.2, 0.1, 0, 0.1, 1, 0, 0, 0, 0.1, 0.9;
  return rest;
}

inline Effect tet(Strain strain) {
  return TetStrain{{{0, 1, 2, 3}}, {rest_tet()}, {100, 0.3}, strain};
}
inline Effect triangle(double young) {
  Eigen::Matrix3d rest;
  rest << 0, 1, 0.3, 0, 0.2, 0.8, 0, 0, 0.1;
  return TriangleStrain{{{0, 1, 2}}, {rest}, {young, 0.3}, 0.5};
}

}  // namespace pbd::test
