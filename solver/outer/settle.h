// Takes v and the impulses of compliant rows, linearised at v where the potential has this gradient, to the
// solution of these rows, (M + J^T Sigma^-1 J) dv = -gradient, dp = -Sigma^-1 J dv, by conjugate gradients
// preconditioned by the metric P. Contacts' impulses stay, given forces.
#pragma once

#include "outer/metric.h"
#include "rows/rows.h"

namespace pbd {

class Settling {
 public:
  /// Until what is left of the gradient is as small as `accuracy` in |.|_W (sqrt(J)), or 50 iterations.
  void solve(double accuracy, const Points& gradient, Metric& metric, Rows& rows, Points& v);

 private:
  Points preconditioned_, rest_, along_, pushed_;
};

}  // namespace pbd
