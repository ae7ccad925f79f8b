#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "scenes.h"

using namespace pbd;

namespace {

/// Unit cube of 3^3 cells with its inner nodes moved off the grid; the mesh is irregular but valid.
TetMesh irregular_cube() {
  TetMesh mesh = kuhn_grid({3, 3, 3}, Vec3::Ones());
  for (int node = 0; node < mesh.x.cols(); ++node) {
    auto x = mesh.x.col(node);
    if (x.minCoeff() > 0 && x.maxCoeff() < 1)
      x += 0.06 * Vec3(std::sin(1.0 * node), std::sin(2.0 * node + 1), std::sin(3.0 * node + 2));
  }
  return mesh;
}

}  // namespace

TEST_CASE("patch test: with the boundary moved affinely the inner nodes follow, for all six strains") {
  const TetMesh mesh = irregular_cube();
  const int component = GENERATE(0, 1, 2, 3, 4, 5);
  const auto strain = GENERATE(Strain::green, Strain::corotational, Strain::linear);
  Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
  constexpr std::array<std::array<int, 2>, 6> place{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
  f(place[static_cast<std::size_t>(component)][0], place[static_cast<std::size_t>(component)][1]) += 0.1;

  Scene scene;
  add_solid(scene, mesh, 1000, {1e6, 0.3}, strain);
  for (int node = 0; node < scene.nodes(); ++node) {
    const Vec3 rest = mesh.x.col(node);
    if (rest.minCoeff() > 0 && rest.maxCoeff() < 1) continue;
    scene.mass[static_cast<std::size_t>(node)] = infinity;
    scene.initial.x.col(node) = f * rest;
  }
  Method method;
  method.relaxation = "direct";
  method.tolerance = 1e-13;
  Workspace workspace(scene, method);
  State state = scene.initial;
  const double h = 1e4;  // inertia is negligible: one step ends in static equilibrium
  step(workspace, h, state);
  CHECK((state.x - f * mesh.x).cwiseAbs().maxCoeff() < 1e-12);
}
