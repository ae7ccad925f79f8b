// Block Jacobi with Nesterov's momentum.
#pragma once

#include "linear/spectral_bound.h"
#include "linear/sweeps.h"

namespace pbd {

/// Nesterov's acceleration of block Jacobi with step 1/bound and restart by the gradient test
/// (nesterov1983method, odonoghue2015adaptive). The momentum is kept from one linearisation of a step to the
/// next. Every change of the impulses gives a Rayleigh quotient; where it exceeds the bound, the bound is
/// raised and the momentum begins anew (the backtracking of beck2009fast).
class NesterovJacobi {
 public:
  static constexpr std::string_view name = "nesterov_jacobi";
  static constexpr bool solves_any_rows = true;
  void begin(Rows& rows, const Points& v, bool fresh);
  Sweep sweep(Rows& rows, Points& v, BlockSeconds seconds);
  void forget() { bound_.forget(); }
  std::int64_t further_sweeps() const { return bound_.sweeps(); }

 private:
  bool bound_holds(const Rows& rows, const Points& v, double residual_squared, double compliant);
  void restart() { theta_ = 1, beta_ = 0; }

  SpectralBound bound_;
  double omega_ = 1;
  double theta_ = 1;
  double beta_ = 0;
  std::vector<double> previous_;  // impulses one sweep ago, one entry a row
  Points previous_v_;             // velocities one sweep ago
  Points extrapolated_;           // velocities at the extrapolated impulses
};

}  // namespace pbd
