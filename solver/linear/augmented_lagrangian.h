// The augmented Lagrangian of linear rows with bounds and friction, by velocities. With the slips s_i = mu
// |u_t| held fixed, Coulomb's law is that of the convex cone (rows/laws.h) for rows shifted by s_i
// e_n, and the impulses that minimise 1/2 |v - v_free|_M^2 under the rows are found by rounds of
//   p_i(v) = P_i(p_i - (sigma_i + Sigma_i)^-1 (J_i v + b_i + s_i e_n + Sigma_i p_i)),   v = argmin of a
//   convex function whose gradient is M (v - v_free) - J^T p(v),   p <- p(v),   s from the new v
// (rockafellar1976augmented; for contact alart1991mixed; s as a fixed point: acary2011formulation). The
// function is minimised by Newton's method with line search, which converges from anywhere; the smaller
// sigma_i is beside N_ii, the fewer rounds it takes, and the more steps Newton's method from afar: it falls
// from round to round as far as 1e-4.
#pragma once

#include "linear/sparse_factor.h"
#include "linear/sweeps.h"
#include "rows/velocity_system.h"

namespace pbd {

class AugmentedLagrangian {
 public:
  /// Not `box`, a pyramid: P is a cone's here.
  static bool solves(Friction law) { return law != Friction::box; }

  /// True unless impulses obey a law it does not solve, or rows are local and know no masses.
  static bool applies(const Rows& rows);

  static constexpr std::string_view name = "augmented_lagrangian";
  static constexpr bool solves_any_rows = false;
  void begin(Rows&, const Points&, bool) { further_sweeps_ = 0; }

  /// One `improve`; returns the natural residual it met.
  Sweep sweep(Rows& rows, Points& v, BlockSeconds seconds);

  /// Factorisations since `begin`.
  std::int64_t further_sweeps() const { return further_sweeps_; }

  /// Some rounds from the rows' impulses and v, which belong together; returns the number of factorisations.
  int improve(Rows& rows, Points& v);

 private:
  /// The function's value at v, J; sets `asked_`, `gradient_` and the matrix of second derivatives.
  double evaluate(const Rows& rows, const Points& v);

  struct Minimised {
    int factorisations;
    bool ended;  // as near as its rounding allows; else its steps are spent
  };
  Minimised minimise(const Rows& rows, Points& v);

  Eigen::VectorXd anchor_, slip_, asked_;  // p (N s), s_i e_n (m/s) and p(v) (N s): one entry a row
  Points free_, tried_;
  Eigen::VectorXd gradient_, step_;  // N s, m/s: one entry an unknown
  VelocitySystem system_;
  SparseMatrix matrix_;
  SparseLdlt factor_;
  double share_ = 1;  // sigma_i over N_ii
  bool analysed_ = false;
  std::int64_t further_sweeps_ = 0;
};

}  // namespace pbd
