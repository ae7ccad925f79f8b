#pragma once

#include "scene.h"

namespace pbd::test {

/// In one plane a triangle of 0.1 kg a corner, its edge along y, comes with 0.6 m/s to the longer edge of a
/// fixed one 5 mm away from where they touch; the edge leans by so much (m).
inline Scene side_by_side(double leaning) {
  constexpr double gap = 5e-3, thickness = 2e-3;
  Scene scene;
  Contact contact;
  contact.thickness = thickness;
  contact.law[0].friction = 0;
  const double beside = gap + thickness;
  std::vector<int> node;
  for (const Vec3& x : {Vec3(0, -0.05, 0), Vec3(-leaning, 0.05, 0), Vec3(-0.1, 0, 0)})
    node.push_back(add_node(scene, x, 0.1, Vec3(0.6, 0, 0)));
  for (const Vec3& x : {Vec3(beside, -0.1, 0), Vec3(beside, 0.1, 0), Vec3(beside + 0.1, 0, 0)})
    node.push_back(add_node(scene, x, infinity));
  contact.triangle = {{node[0], node[2], node[1]}, {node[3], node[4], node[5]}};
  scene.effects.emplace_back(contact);
  return scene;
}

}  // namespace pbd::test
