// Linear elasticity on linear tetrahedra: statics, vibrations and a manufactured solution.
//
//   statics     K u = F,    K the Hessian of the energies of `linear` strain at rest (energies.h)
//   vibrations  K u = (2 pi f)^2 M u
//
// M is consistent, rho V/20 (1 + delta_ab) per node pair, or lumped, rho V/4 per node.
//
//   manufactured  u_i = a sin(pi x) sin(pi y) sin(pi z) on the unit cube, u = 0 on the boundary
//                 body force b_i = -div sigma(u)_i = -(lambda + mu) d_i(div u) + 3 pi^2 mu u_i
//
// (hughes2000finite), ch. 3, 7; subspace iteration: (bathe2014finite), ch. 11.
#pragma once

#include <functional>

#include "mesh.h"

namespace pbd::reference {

/// A meshed body held at some nodes.
struct LinearSolid {
  TetMesh mesh;
  Material material;
  double density = 1000;    // kg/m^3
  std::vector<bool> fixed;  // per node
};

/// Beam of `size` (m) clamped at x = 0, Kuhn grid.
LinearSolid clamped_beam(const std::array<int, 3>& cells, const Vec3& size, const Material& material,
                         double density);

/// Nodal forces (N, 3 x N) of a uniform traction (N/m^2) on the boundary triangles whose three nodes
/// `on_face` selects.
Points face_loads(const TetMesh& mesh, const std::function<bool(const Vec3&)>& on_face, const Vec3& traction);

/// Displacements (m, 3 x N) under nodal forces (N).
Points linear_static(const LinearSolid& solid, const Points& loads);

enum class MassMatrix { consistent, lumped };
/// The `count` lowest eigenfrequencies, Hz, ascending, converged to 1e-12. The body must be held.
std::vector<double> linear_modes(const LinearSolid& solid, int count, MassMatrix mass);

struct ManufacturedError {
  double l2;           // |u - u_h| in L2
  double h1_seminorm;  // |grad u - grad u_h| in L2
};
/// Errors of the Kuhn grid of n^3 cells, amplitude 0.1 m; integrals by 6^3 Gauss points a tetrahedron.
ManufacturedError manufactured_cube(int n, const Material& material);

/// 1/2 a(u, u) of the manufactured solution, J: pi^2 a^2/16 (3 (lambda + mu) + 9 mu).
double manufactured_energy(const Material& material);

}  // namespace pbd::reference
