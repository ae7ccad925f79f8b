#include "studies/accuracy/spring_network.h"

#include <cmath>

#include "closed_form_solids.h"
#include "linear_fem.h"

namespace pbdcheck {

using namespace pbd;

Distance edge_springs(const TetMesh& mesh, double modulus, int first) {
  Distance springs;
  for (const auto& [a, b] : edges(mesh)) {
    const double length = (mesh.x.col(a) - mesh.x.col(b)).norm();
    springs.node.push_back({first + a, first + b});
    springs.rest_length.push_back(length);
    springs.compliance.push_back(1 / (modulus * length));
  }
  return springs;
}

double work_of(const Points& loads, const Points& displacement) {
  return loads.cwiseProduct(displacement).sum();
}

Network fitted_network(const BeamMesh& each, double axial_theory, double shear_theory) {
  const Scene unit = spring_beam(each.mesh, 1);
  const Statics axial = static_equilibrium(unit, small_load * each.axial);
  const Statics shear = static_equilibrium(unit, small_load * each.shear);
  const double a = work_of(each.axial, axial.displacement) / small_load;
  const double s = work_of(each.shear, shear.displacement) / small_load;
  const double kappa = std::sqrt((a / axial_theory) * (s / shear_theory));
  return {a / kappa, s / kappa, kappa, lateral_contraction(each.mesh, beam_size, axial.displacement),
          shear.report.status == Status::ok ? axial.report : shear.report};
}

CubeNetwork fitted_cube(int cells) {
  // A strain as small to the geometry as rounding is to it.
  constexpr double strain = 1e-8, side = 1;
  const TetMesh mesh = kuhn_grid({cells, cells, cells}, Vec3::Constant(side));
  const auto pull = [&](double end, double along) {
    return reference::face_loads(
        mesh, [=](const Vec3& x) { return std::abs(x.x() - end) < side * 1e-9; }, along * Vec3::UnitX());
  };
  const Points loads = strain * beam_young * (pull(side, 1) + pull(0, -1));
  Scene scene;
  add_solid(scene, mesh, beam_density, {beam_young, 0}, Strain::linear);
  scene.effects = {edge_springs(mesh, beam_young)};
  const Statics at = static_equilibrium(scene, loads);
  const double theory = strain * strain * beam_young * side * side * side;
  return {work_of(loads, at.displacement) / theory,
          lateral_contraction(mesh, Vec3::Constant(side), at.displacement), at.report};
}

double kuhn_network_poisson() {
  Points springs(3, 7);
  springs << 1, 0, 0, 1, 0, 1, 1,  //
      0, 1, 0, 1, 1, 0, 1,         //
      0, 0, 1, 0, 1, 1, 1;
  return reference::spring_lattice_poisson(springs, springs.colwise().norm());
}

}  // namespace pbdcheck
