// Cholesky factor of a sparse symmetric matrix of 3 x 3 blocks, or of one number a block.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "rows/source.h"

namespace pbd {

/// Pattern of the Cholesky factor L of a permuted matrix, by block columns, the diagonal first.
struct FactorPattern {
  std::vector<int> column;                // of each node in L, -1 for infinite mass
  std::vector<std::array<int, 2>> pairs;  // of nodes, that the matrix's blocks were of
  std::vector<int> start, row;

  int columns() const { return static_cast<int>(start.size()) - 1; }
  bool is_of(const std::vector<double>& inverse_mass, const std::vector<MetricEntry>& entries) const;
  /// Multiplications of blocks that the factorisation takes.
  double products() const;
};

/// L^-1 of a unit load on one node's columns: where it is not zero, from the node's column of L up to a root
/// of the elimination tree.
struct FactorReach {
  std::vector<int> column;
  std::vector<Eigen::Matrix3d> part;
};

/// L of B x B blocks. With B = 1 the same L serves x, y and z.
template <int B, class Real>
struct MetricFactor {
  std::vector<Eigen::Matrix<Real, B, B>> lower;  // the inverse in the place of diagonal blocks

  /// Solves L L^T x = b in place, one column a block column of L.
  void solve(const FactorPattern& pattern, Points& x) const;

  FactorReach reach(const FactorPattern& pattern, int column) const;
};

/// Fill-reducing order of the nodes and pattern of L, from the blocks of a matrix.
FactorPattern analyse(const std::vector<double>& inverse_mass, const std::vector<MetricEntry>& entries);

/// The factor of M + the entries (B = 1: one number a block, their mean diagonal). A pivot lost to rounding
/// counts as stiff.
template <int B>
std::vector<Eigen::Matrix<double, B, B>> factorised(const FactorPattern& pattern,
                                                    const std::vector<double>& inverse_mass,
                                                    const std::vector<MetricEntry>& entries);

/// Smallest over largest pivot of a factor with inverse diagonal blocks, squared: of the order of the
/// matrix's smallest over largest eigenvalue.
double pivot_ratio(const FactorPattern& pattern, const std::vector<Eigen::Matrix3d>& lower);

}  // namespace pbd
