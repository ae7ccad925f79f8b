// Sparse LDL^T of the quasi-definite system of velocities and hard impulses.
#pragma once

#include "linear/sparse_factor.h"
#include "linear/sweeps.h"
#include "rows/velocity_system.h"

namespace pbd {

/// Sparse factorisation, exact up to rounding; each sweep is one step of iterative refinement. Compliant
/// constraints are eliminated into the primal normal equations M + J^T Sigma^-1 J, those with (nearly) no
/// compliance keep their rows, unless their block has more rows than there are unknown velocities:
///   [M + J_c^T Sigma_c^-1 J_c   J_d^T           ] [dv   ]   [J_c^T Sigma_c^-1 r_c]
///   [J_d                        -Sigma_d - shift] [-dp_d] = [r_d                 ]
/// The matrix is quasi-definite, so LDL^T needs no pivoting; the shift, 1e-10 of J W J^T, keeps redundant
/// rows solvable and is removed by the refinement. Hard rows that move nothing keep their impulse. Rows whose
/// impulse has bounds are kept; those that a sweep of Gauss-Seidel would leave at a bound are held there, and
/// each sweep with another set of them begins with another factorisation (the primal-dual active sets of
/// hintermueller2003primal, which are not proven to end). Which constraints are eliminated is decided when
/// the rows' generation changes. Not for contacts. Allocates in Eigen's factorisation and solves.
class Ldlt {
 public:
  static constexpr std::string_view name = "ldlt";
  static constexpr bool solves_any_rows = false;
  static bool applies(const Rows& rows) { return !rows.contacts; }
  void begin(Rows& rows, const Points& v, bool fresh);
  Sweep sweep(Rows& rows, Points& v, BlockSeconds seconds);

 private:
  template <class Put>
  void assemble(const Rows& rows, Put&& put) const;
  void analyse(const Rows& rows);
  double right_hand_side(const Rows& rows, const Points& v);
  void correct(Rows& rows, const Points& v);
  bool find_held(Rows& rows, Points& v);
  void factorise(const Rows& rows);

  VelocitySystem system_;
  std::vector<std::vector<int>> impulse_column_;  // per block and constraint, -1 if eliminated
  std::vector<int> slot_;                         // of each assembled entry in the matrix
  SparseMatrix matrix_;                           // lower triangle
  SparseLdlt factor_;
  bool factored_ = false;
  int generation_ = 0;  // of the rows
  Eigen::VectorXd right_, solution_;
  Points changed_;
  double last_residual_ = 0;
  std::vector<std::vector<bool>> held_;  // at a bound, per block with bounds and constraint
};

}  // namespace pbd
