#include "harness/rows_of_step.h"

#include <catch2/catch.hpp>

using namespace pbdcheck;

TEST_CASE("rows of a damped spring lead where a step of implicit Euler does") {
  constexpr double h = 0.01, mass = 2, stiffness = 300, retardation = 0.05, stretch = 0.1, speed = 3;
  pbd::Scene scene;
  pbd::add_node(scene, pbd::Vec3::Zero(), pbd::infinity);
  pbd::add_node(scene, pbd::Vec3(1 + stretch, 0, 0), mass, pbd::Vec3(speed, 0, 0));
  scene.effects.emplace_back(pbd::Distance{{{0, 1}}, {1}, {1 / stiffness}, {retardation}});
  // m (v' - v)/h = -k (c + h v') - k T v'
  const double expected =
      (speed - h * stiffness * stretch / mass) / (1 + h * stiffness * (h + retardation) / mass);
  const pbd::Points v = dense_solution(linear_step(scene, scene.initial, h));
  CHECK((v.col(1) - pbd::Vec3(expected, 0, 0)).norm() <= 1e-12 * speed);
}
