// Cholesky factor of a sparse symmetric matrix of 3 x 3 blocks, or of one number a block, by panels of
// columns: left-looking, its products dense ones (ng1993block).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "outer/metric_pattern.h"

namespace pbd {

/// L^-1 of a unit load on one node's columns: where it is not zero, from the node's column of L up to a root
/// of the elimination tree.
struct FactorReach {
  std::vector<int> column;
  std::vector<Eigen::Matrix3d> part;
};

/// L of B x B blocks. With B = 1 the same L serves x, y and z.
template <int B, class Real>
struct MetricFactor {
  PanelNumbers<Real> number;  // of the panels; the inverse in the place of diagonal blocks
  Points part = {};           // of x, that belongs to a panel's rows

  /// Solves L L^T x = b in place, one column a block column of L.
  void solve(const FactorPattern& pattern, Points& x);

  FactorReach reach(const FactorPattern& pattern, int column) const;
};

/// Sets `number` to the factor of M + the entries (B = 1: one number a block, their mean diagonal). A pivot
/// that is not positive by more than rounding counts as stiff; where the matrix shall be `definite`, it ends
/// there and returns false.
template <int B>
bool factorise(const FactorPattern& pattern, const std::vector<double>& inverse_mass,
               const std::vector<MetricEntry>& entries, bool definite, PanelNumbers<double>& number);

/// Smallest over largest pivot of a factor of 3 x 3 blocks, squared: of the order of the matrix's smallest
/// over largest eigenvalue.
double pivot_ratio(const FactorPattern& pattern, const PanelNumbers<double>& number);

}  // namespace pbd
