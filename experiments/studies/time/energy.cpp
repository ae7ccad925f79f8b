// What do integrators do to energy and momentum?
#include "studies/time/energy.h"

#include <Eigen/Geometry>
#include <cmath>

#include "harness/probes.h"
#include "mesh.h"
#include "scenes/standard.h"
#include "studies/experiments.h"

namespace pbdcheck {

using namespace pbd;

namespace {

template <class F>
Vec3 sum_over_finite(const Scene& scene, F&& term) {
  Vec3 sum = Vec3::Zero();
  for (int node = 0; node < scene.nodes(); ++node)
    if (const double mass = scene.mass[static_cast<std::size_t>(node)]; std::isfinite(mass))
      sum += mass * term(node);
  return sum;
}

}  // namespace

double energy_scale(const Scene& scene) {
  const Points& x = scene.initial.x;
  double weight = 0;
  for (const auto& effect : scene.effects)
    if (const auto* gravity = std::get_if<Gravity>(&effect))
      for (const double mass : scene.mass)
        if (std::isfinite(mass)) weight += mass * gravity->acceleration.norm();
  return kinetic_energy(scene, scene.initial) + elastic_energy(scene, scene.initial) +
         weight * (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).norm();
}

double momentum_scale(const Scene& scene, const State& state) {
  return sum_over_finite(scene, [&](int node) -> Vec3 { return {state.v.col(node).norm(), 0, 0}; }).x();
}

Vec3 linear_momentum(const Scene& scene, const State& state) {
  return sum_over_finite(scene, [&](int node) -> Vec3 { return state.v.col(node); });
}

Vec3 angular_momentum(const Scene& scene, const State& state) {
  return sum_over_finite(
      scene, [&](int node) -> Vec3 { return Vec3(state.x.col(node)).cross(Vec3(state.v.col(node))); });
}

Scene free_links(double compliance) {
  Scene scene = chain(6, 10, true);
  scene.effects.erase(scene.effects.begin());
  for (double& each : std::get<Distance>(scene.effects[0]).compliance) each = compliance;
  for (int node = 0; node < scene.nodes(); ++node)  // no stretching at first
    scene.initial.v.col(node) = Vec3(0.1, std::cos(2.0 * node), std::sin(3.0 * node)) / 2;
  return scene;
}

Scene free_net() {
  const TriangleMesh mesh = grid_sheet({3, 3}, {1, 1});
  Scene scene;
  const int first = add_sheet_nodes(scene, mesh, 0.2);
  scene.effects.emplace_back(sheet_links(mesh, first, 0.1));
  scene.effects.emplace_back(sheet_bending(mesh, first, 1e2));
  for (int node = 0; node < scene.nodes(); ++node) {
    const Vec3 x = scene.initial.x.col(node) - Vec3(0.5, 0.5, 0);
    scene.initial.v.col(node) = Vec3(0.1, 0.2, x.x() * x.y()) + Vec3(0.3, 0.2, 1).cross(x);
  }
  return scene;
}

Scene free_beam(int cells, double young) {
  constexpr double length = 1, width = 0.25;
  Scene scene;
  add_solid(scene, kuhn_grid({cells, 1, 1}, Vec3(length, width, width)), 1000, {young, 0.3}, Strain::green);
  for (int node = 0; node < scene.nodes(); ++node) {  // about the first bending mode, and a spin
    const Vec3 x = scene.initial.x.col(node) - Vec3(length, width, width) / 2;
    scene.initial.v.col(node) = Vec3(0.1, 0, 4 * x.x() * x.x() - 1.0 / 3) + Vec3(0, 1, 1).cross(x);
  }
  return scene;
}

void energy(Context& context) {
  context.begin(4);
  energy_series(context);
  energy_drift(context);
  energy_momentum(context);
  energy_map(context);
}

}  // namespace pbdcheck
