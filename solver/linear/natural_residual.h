// How far impulses and velocities are from what their laws ask for: each constraint's residual is what a step
// of block Jacobi would change, in the norm of N_ii.
#pragma once

#include <cmath>

#include "rows/laws.h"
#include "rows/velocity_system.h"

namespace pbd {

/// sqrt(sum_i) of the squared residuals of all rows, sqrt(J), where constraint i of a block, of whose rows
/// one is the `first`, misses `missed(block, i, first)`.
template <class Missed>
double natural_residual_of(const Rows& rows, Missed&& missed) {
  double squared = 0;
  each_constraint(rows, [&](const auto& block, std::size_t i, Eigen::Index first) {
    squared += squared_residual(block, i, missed(block, i, first));
  });
  return std::sqrt(squared);
}

/// The same of the rows at v.
double natural_residual(const Rows& rows, const Points& v);

}  // namespace pbd
