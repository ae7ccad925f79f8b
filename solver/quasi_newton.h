// Quasi-Newton iteration on the incremental potential of compliant rows,
//   phi(v) = 1/2 |v - v_free|_M^2 + 1/2 sum_i (c_i/d)^T Sigma_i^-1 (c_i/d),   c at x0 + d v,
// whose gradient M (v - v_free) - J^T p with p = -Sigma^-1 c/d is the step's primal residual. The metric P of
// metric.h is factored once per step length. L-BFGS on top (Nocedal 1980), backtracking on phi.
#pragma once

#include <vector>

#include "metric.h"
#include "rows.h"

namespace pbd {

class QuasiNewton {
 public:
  explicit QuasiNewton(int memory) : memory_(memory) {}

  Metric& metric() { return metric_; }

  /// Forgets the curvature of the last step.
  void forget() { count_ = 0; }

  /// Notes the change of v and gradient that the last iterate brought.
  void learn(const Points& step, const Points& change);

  /// Descent direction -H gradient.
  void direction(const Points& gradient, Points& result);

  /// Takes v and the impulses of compliant rows, linearised at v where the potential has this gradient, to
  /// the solution of these rows, (M + J^T Sigma^-1 J) dv = -gradient, dp = -Sigma^-1 J dv: conjugate
  /// gradients preconditioned by P, until what is left of the gradient is as small as `accuracy` in |.|_W
  /// (sqrt(J)).
  void solve_rows(double accuracy, const Points& gradient, Rows& rows, Points& v);

 private:
  int memory_;
  int count_ = 0;
  Metric metric_;
  Points q_, rest_, along_, pushed_;
  std::vector<double> alpha_;
  std::vector<Points> steps_, changes_;
  std::vector<double> curvature_;  // of each pair, change . step
};

}  // namespace pbd
