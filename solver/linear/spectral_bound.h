// How large a step block Jacobi may take: a bound of the largest eigenvalue.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "rows/rows.h"

namespace pbd {

/// Upper estimate of the largest eigenvalue of D^-1 N, D = blockdiag(N_ii): the smaller of the proven bound,
/// the largest number of constraints at a node (N <= sum_a n_a J_a W_a J_a^T + Sigma), and 1.05 times a power
/// iteration whose vector is kept from one linearisation to the next; that one is not proven to be a bound.
class SpectralBound {
 public:
  double update(const Rows& rows, const Points& like);

  /// Takes note of a Rayleigh quotient of D^-1 N that was met: the eigenvalue is no smaller.
  void met(double quotient) { least_ = std::max(least_, quotient); }

  /// Begins anew: what was learnt of other rows counts no more.
  void forget() { vector_.clear(), least_ = 1; }

  std::int64_t sweeps() const { return sweeps_; }  // of power iteration, in the last update

 private:
  double power_step(const Rows& rows);
  std::vector<double> vector_;  // one entry a row
  Points velocity_;
  int generation_ = 0;  // of the rows
  double constraints_at_a_node_ = 0;
  double least_ = 1;
  std::int64_t sweeps_ = 0;
};

}  // namespace pbd
