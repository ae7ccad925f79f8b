// The judge's residual of somebody's step: small at the judge's own solution, and as large as what is wrong.
#include "residual.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "mesh.h"
#include "primal_newton.h"

using namespace pbd;

namespace {

/// Three nodes hanging from a fixed one, a hard link, a soft one and an anchor.
Scene rope() {
  Scene scene;
  add_node(scene, Vec3::Zero(), infinity);
  add_node(scene, Vec3(1, 0, 0), 1);
  add_node(scene, Vec3(2, 0, 0), 2);
  scene.effects.emplace_back(Gravity{});
  scene.effects.emplace_back(
      Distance{.node = {{0, 1}, {1, 2}}, .rest_length = {1, 0.9}, .compliance = {0, 1e-3}});
  scene.effects.emplace_back(Anchor{.node = {2}, .target = {Vec3(2, 0, 0.1)}, .compliance = {1e-2}});
  return scene;
}

Scene solid(Strain strain) {
  Scene scene;
  add_solid(scene, kuhn_grid({2, 1, 1}, Vec3(2, 1, 1)), 1000, {1e5, 0.3}, strain);
  scene.effects.emplace_back(Gravity{});
  for (int node = 0; node < scene.nodes(); ++node)
    if (scene.initial.x(0, node) == 0) scene.mass[node] = infinity;
  return scene;
}

reference::StepResidual of_newton(const Scene& scene, double h, double shift) {
  const auto solved = reference::primal_newton(scene, scene.initial, h);
  State end{h, solved.x, solved.v};
  end.x.col(scene.nodes() - 1).z() += shift;
  end.v.col(scene.nodes() - 1).z() += shift / h;
  return reference::residual_of(scene, scene.initial, h, end);
}

}  // namespace

TEST_CASE("residual vanishes at the solution of the step and nowhere near it") {
  for (const Scene& scene :
       {rope(), solid(Strain::green), solid(Strain::corotational), solid(Strain::linear)}) {
    const auto solved = of_newton(scene, 0.02, 0);
    CHECK(solved.residual < 1e-10 * solved.scale);
    CHECK(solved.rounding < 1e-9 * solved.scale);
    CHECK(of_newton(scene, 0.02, 1e-3).residual > 1e-4 * solved.scale);
  }
}

TEST_CASE("residual of a free fall that was left out is the whole momentum") {
  Scene scene;
  add_node(scene, Vec3::Zero(), 4);
  scene.effects.emplace_back(Gravity{});
  const auto still = reference::residual_of(scene, scene.initial, 0.1, scene.initial);
  CHECK(std::abs(still.residual - 2 * 9.81 * 0.1) < 1e-12);
  CHECK(std::abs(still.scale - still.residual) < 1e-12);
}

TEST_CASE("residual of a hard link between nodes that cannot move is its error, weighed with all masses") {
  Scene scene;
  add_node(scene, Vec3::Zero(), infinity);
  add_node(scene, Vec3(1, 0, 0), infinity);
  add_node(scene, Vec3(5, 0, 0), 4);
  scene.effects.emplace_back(Distance{.node = {{0, 1}}, .rest_length = {1.5}, .compliance = {0}});
  const auto still = reference::residual_of(scene, scene.initial, 0.1, scene.initial);
  CHECK(std::abs(still.residual - 2 * 0.5 / 0.1) < 1e-12);
}
