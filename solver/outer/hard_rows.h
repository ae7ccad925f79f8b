// Rows that quasi_newton does not eliminate stay dual, with its metric P in the place of M:
//   J v + b + Sigma p = 0,   v = u + P^-1 J^T p,   u = v_k - P^-1 gradient
// A step of that is v_k+1 = argmin gradient . (v - v_k) + 1/2 |v - v_k|_P^2 under the rows: proximal, in
// another metric, with the solutions of the step as fixed points.
#pragma once

#include <cstdint>
#include <vector>

#include "outer/metric.h"
#include "rows/rows.h"

namespace pbd {

/// Conjugate gradients on (J P^-1 J^T + Sigma) p = -(b + J u), preconditioned by its diagonal blocks with P's
/// diagonal for P.
class HardRows {
 public:
  /// Takes v from u to the solution, and the impulses with it, until the residual sqrt(r^T D^-1 r) is as
  /// small as `accuracy` (sqrt(J)) or `most` iterations are spent; returns their number. `eliminated` tells a
  /// block that has no part in it. Changes the rows' inverse masses and diagonals.
  std::int64_t solve(Rows& rows, const std::vector<bool>& eliminated, Metric& metric, double accuracy,
                     int most, Points& v);

 private:
  struct System;
  std::vector<double> residual_, direction_, image_;  // one entry a row
  Points force_, push_;
};

}  // namespace pbd
