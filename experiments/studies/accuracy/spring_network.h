// An elastic solid as a network: springs along all edges of its mesh, and the one number that fits them.
//
//   stiffness of a spring (N/m)   kappa E l,   l its length at rest
//
// kappa is all that a network has to fit with: compliances go with 1/kappa, lateral contraction not at all.
#pragma once

#include "studies/accuracy/beam_statics.h"

namespace pbdcheck {

enum class Model { elements, springs };
inline constexpr std::array<std::string_view, 2> model_names{"tet_p1", "springs"};

/// Springs along the edges of a mesh whose first node in the scene is `first`; `modulus` is kappa E (Pa).
pbd::Distance edge_springs(const pbd::TetMesh& mesh, double modulus, int first = 0);

/// F . u, J.
double work_of(const pbd::Points& loads, const pbd::Points& displacement);

/// The beam as a network whose kappa fits axial and bending compliance of rod and beam theory in the least
/// squares of their logarithms, so that neither load case is favoured.
struct Network {
  double axial, shear;  // F . u at 1 N, J, with the fitted kappa
  double kappa, lateral;
  pbd::Report report;
};
Network fitted_network(const BeamMesh& each, double axial_theory, double shear_theory);

/// A free cube as a network whose kappa fits its axial compliance, and its lateral over axial strain.
struct CubeNetwork {
  double kappa, lateral;
  pbd::Report report;
};
CubeNetwork fitted_cube(int cells);

/// Of the network that a Kuhn grid's edges make as the cells become many: a node a cell, and seven springs.
double kuhn_network_poisson();

}  // namespace pbdcheck
