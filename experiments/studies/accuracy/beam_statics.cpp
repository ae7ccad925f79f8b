#include "studies/accuracy/beam_statics.h"

#include <cmath>
#include <numbers>

#include "linear_fem.h"
#include "studies/accuracy/spring_network.h"

namespace pbdcheck {

using namespace pbd;

namespace {

bool on_end(const Vec3& x) {
  return x.x() > beam_size.x() * (1 - 1e-9);
}

/// M u, that of fixed nodes 0.
Points inertia_of(const Scene& scene, const Points& u) {
  Points all = Points::Zero(3, u.cols());
  for (int node = 0; node < scene.nodes(); ++node)
    if (const double mass = scene.mass[static_cast<std::size_t>(node)]; std::isfinite(mass))
      all.col(node) = mass * u.col(node);
  return all;
}

FirstMode mode_from(const Scene& scene, Points loads) {
  constexpr int iterations = 5;  // each leaves 1/39^2 or less of the next mode's part of w^2
  FirstMode found;
  for (int k = 0; k < iterations; ++k) {
    const Points small = small_load / loads.cwiseAbs().sum() * loads;
    const Statics at = static_equilibrium(scene, small);
    loads = inertia_of(scene, at.displacement);
    const double square =  // Rayleigh's quotient
        small.cwiseProduct(at.displacement).sum() / loads.cwiseProduct(at.displacement).sum();
    found.frequency = std::sqrt(square) / (2 * std::numbers::pi);
    if (found.report.status == Status::ok) found.report = at.report;
  }
  found.inertia = loads;
  return found;
}

}  // namespace

reference::Beam beam_theory(double poisson) {
  return {beam_size.x(), beam_size.y(), beam_size.z(), beam_young, poisson, beam_density};
}

Points end_loads(const TetMesh& mesh, const Vec3& direction) {
  return reference::face_loads(mesh, on_end, direction / (beam_size.y() * beam_size.z()));
}

BeamMesh beam_mesh(int n) {
  TetMesh mesh = kuhn_grid({10 * n, n, n}, beam_size);
  const Points shear = end_loads(mesh, Vec3::UnitZ()), axial = end_loads(mesh, Vec3::UnitX());
  return {n, std::move(mesh), shear, axial};
}

Scene solid_beam(const TetMesh& mesh, double poisson, Strain strain) {
  Scene scene;
  add_solid(scene, mesh, beam_density, {beam_young, poisson}, strain);
  clamp_smallest_x(scene);
  return scene;
}

Scene spring_beam(const TetMesh& mesh, double kappa) {
  Scene scene = solid_beam(mesh, 0);
  scene.effects = {edge_springs(mesh, kappa * beam_young)};
  return scene;
}

Statics static_equilibrium(Scene scene, const Points& loads) {
  constexpr double h = 1;
  constexpr int steps = 8;
  scene.effects.emplace_back(nodal_force(loads));
  Method method;
  method.relaxation = "direct";
  method.tolerance = 1e-12;  // of the step's scale, h f/m, which is far larger than what is left to move
  Workspace workspace(scene, method);
  State state = scene.initial;
  Report report;
  for (int k = 0; k < steps; ++k) {
    const Report last = step(workspace, h, state);
    if (report.status == Status::ok) report = last;
  }
  return {state.x - scene.initial.x, report};
}

FirstMode first_mode(const Scene& scene, const TetMesh& mesh) {
  const FirstMode with = mode_from(scene, end_loads(mesh, Vec3(0, 1, 1)));
  const FirstMode against = mode_from(scene, end_loads(mesh, Vec3(0, 1, -1)));
  return with.frequency < against.frequency ? with : against;
}

double lateral_contraction(const TetMesh& mesh, const Vec3& size, const Points& displacement) {
  double cell = size.x();
  for (int node = 0; node < mesh.x.cols(); ++node)
    if (mesh.x(0, node) > 0) cell = std::min(cell, mesh.x(0, node));
  const auto mean = [&](int axis, auto&& chosen) {
    double sum = 0;
    int count = 0;
    for (int node = 0; node < mesh.x.cols(); ++node)
      if (chosen(mesh.x.col(node))) sum += displacement(axis, node), ++count;
    return sum / count;
  };
  const auto along = [&](double at) {
    return mean(0, [&](const Vec3& x) { return std::abs(x.x() - at) < cell / 2; });
  };
  const auto across = [&](double at) {
    return mean(1, [&](const Vec3& x) {
      return std::abs(x.x() - size.x() / 2) < cell / 2 && std::abs(x.y() - at) < cell / 2;
    });
  };
  const double middle = size.x() / 2;
  const double axial = (along(middle + cell) - along(middle - cell)) / (2 * cell);
  return -(across(size.y()) - across(0)) / size.y() / axial;
}

}  // namespace pbdcheck
