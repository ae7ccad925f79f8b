// Quasi-Newton iteration on the incremental potential of compliant rows,
//   phi(v) = 1/2 |v - v_free|_M^2 + 1/2 sum_i (c_i/d)^T Sigma_i^-1 (c_i/d),   c at x0 + d v,
// whose gradient M (v - v_free) - J^T p with p = -Sigma^-1 c/d is the step's primal residual. The metric
//   P = M + s d sum_i L_i,   L_ab = 1/3 trace(J_a^T A^-1 J_b) at rest
// is one number a pair of nodes, shared by x, y and z, so it does not see rotations; it is factored once per
// step length (Liu, Bouaziz, Kavan 2017). L-BFGS on top (Nocedal 1980), backtracking on phi.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "integrators.h"
#include "rows.h"

namespace pbd {

class QuasiNewton {
 public:
  explicit QuasiNewton(int memory) : memory_(memory) {}

  /// Factors P from the pairwise stiffnesses, entries (row, column, N s^2/m times s d) of L on and below the
  /// diagonal.
  void factor(const StepMap& map, const std::vector<double>& inverse_mass,
              const std::vector<Eigen::Triplet<double>>& stiffness);

  bool factored_for(const StepMap& map) const { return d_ == map.d && s_ == map.s; }

  /// Forgets the curvature of the last step.
  void forget() { count_ = 0; }

  /// Notes the change of v and gradient that the last iterate brought.
  void learn(const Points& step, const Points& change);

  /// Descent direction -H gradient.
  void direction(const Points& gradient, Points& result);

  /// result = P^-1 right
  void solve(const Points& right, Points& result);

 private:
  using Columns = Eigen::Matrix<double, 4, Eigen::Dynamic>;  // x, y, z, and 0 for whole vector registers

  int memory_;
  int count_ = 0;
  double d_ = 0, s_ = 0;               // s, of the steps that P is factored for
  std::vector<int> column_;            // of each node in L, -1 for infinite mass
  Eigen::SparseMatrix<double> lower_;  // L of P = L L^T, permuted
  Columns work_;
  Points q_;
  std::vector<double> alpha_;
  std::vector<Points> steps_, changes_;
  std::vector<double> curvature_;  // of each pair, change . step
};

}  // namespace pbd
