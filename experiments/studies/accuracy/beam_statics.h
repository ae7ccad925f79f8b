// The beam that elements and springs are compared on, 1 x 0.1 x 0.1 m, 1000 kg/m^3, clamped at x = 0: meshes,
// loads and what the solver makes of them.
#pragma once

#include "closed_form.h"
#include "scenes/standard.h"
#include "step/step.h"

namespace pbdcheck {

inline const pbd::Vec3 beam_size(1, 0.1, 0.1);
constexpr double beam_density = 1000;
constexpr double beam_young = 1e7;  // Pa

/// Its section and material as formulas take them.
pbd::reference::Beam beam_theory(double poisson);

struct BeamMesh {
  int n;                     // cells across
  pbd::TetMesh mesh;         // 10 n x n x n cells
  pbd::Points shear, axial;  // nodal loads of 1 N in all on the end face
};
BeamMesh beam_mesh(int n);

/// Nodal loads of 1 N in all along `direction` on the end face.
pbd::Points end_loads(const pbd::TetMesh& mesh, const pbd::Vec3& direction);

/// Tetrahedra.
pbd::Scene solid_beam(const pbd::TetMesh& mesh, double poisson, pbd::Strain strain = pbd::Strain::linear);

/// Links along all edges, stiffness kappa E l_rest, masses of the solid.
pbd::Scene spring_beam(const pbd::TetMesh& mesh, double kappa);

/// Loads (N) so small that a network's change of geometry stays below rounding of six digits.
constexpr double small_load = 1e-4;

struct Statics {
  pbd::Points displacement;  // m
  pbd::Report report;        // of the first step that is not ok, else of the last one
};

/// Equilibrium under nodal loads (N) as the end of the motion: implicit Euler multiplies a mode's amplitude
/// by 1/sqrt(1 + (w h)^2) a step, 1/10 or less for the lowest mode here (w > 10 rad/s). 1e-8 of the way is
/// left.
Statics static_equilibrium(pbd::Scene scene, const pbd::Points& loads);

/// The lowest frequency (Hz) by inverse iteration, each iterate an equilibrium under the last one's inertia.
/// Grids of Kuhn's are symmetric in y and z: one mode is, too, the other one changes its sign.
struct FirstMode {
  double frequency = 0;
  pbd::Points inertia{};  // of the mode's displacements u, M u, scaled at will
  pbd::Report report{};
};
FirstMode first_mode(const pbd::Scene& scene, const pbd::TetMesh& mesh);

/// Lateral over axial strain in the middle of a bar of `size` stretched along x, by the means over its cross
/// sections. Takes an even number of cells along x.
double lateral_contraction(const pbd::TetMesh& mesh, const pbd::Vec3& size, const pbd::Points& displacement);

}  // namespace pbdcheck
