// Sums over the elements of a model: gradient, sparse Hessian and Jacobian of L, and dense rows for small
// scenes.
//
//   d2L/dx2 = sum over elements of  W (J_F^T A^-1 J_F + sum_k (dL/dc)_k d2c_k/dF2) W^T
//
// where F = sum_a x_a w_a^T and W is made of w.
#pragma once

#include "energies.h"

namespace pbd::reference {

/// L, its gradient and Hessian by the unknowns, the hard values c and their Jacobian. `magnitude` bounds the
/// sum of the absolute contributions to each gradient entry: the scale of its rounding errors.
struct Derivatives {
  double value = 0;
  Vector gradient, magnitude;
  SparseMatrix hessian;   // unknowns x unknowns, both triangles, constant pattern
  Vector hard;            // c, hard_rows
  SparseMatrix jacobian;  // hard_rows x unknowns
};
enum class Curvature {
  full,
  projected
};  // projected: every element's Hessian by F made positive semidefinite

/// Evaluates L with derivatives; keeps the pattern of the Hessian between calls.
class Assembly {
 public:
  explicit Assembly(const Model& model);
  const Derivatives& at(const Points& x, const Multipliers& multipliers,
                        Curvature curvature = Curvature::full);

 private:
  void add(const Element& element, std::size_t index, const Multipliers& multipliers, Curvature curvature);
  void add_jacobian(const Element& element, int node, int unknown);

  const Model* model_;
  Local local_;
  Derivatives result_;
  std::vector<std::array<int, 16>> offset_;  // of each node pair's block within its columns of the Hessian
  Triplets jacobian_;
};

/// dU/dx of the compliant constraints by the unknowns, N.
Vector energy_gradient(const Model& model, const Points& x);

/// Constraint rows of all elements, hard and compliant, in the scene's order: c, J (rows x unknowns), force
/// multipliers (gamma, or -A^-1 c), and the geometric stiffness sum_i multiplier_i d2c_i/dx2 (N/m). Of
/// corotational tetrahedra J holds the rotation fixed, as their rows do, and the stiffness is what such rows
/// leave out: d(J^T multiplier)/dx + J^T A^-1 (J - dc/dx).
struct Rows {
  std::vector<int> first;  // first row of each element, and the number of rows at the end
  Vector value, multiplier;
  Eigen::MatrixXd jacobian, geometric;
};
/// Dense: for small scenes.
Rows all_rows(const Model& model, const Points& x, const Vector& gamma);

}  // namespace pbd::reference
