// Damped block Jacobi: all constraints at once.
#pragma once

#include "linear/spectral_bound.h"
#include "linear/sweeps.h"

namespace pbd {

/// Damped block Jacobi: dp_i = -omega N_ii^-1 r_i with omega = min(1, 2/bound). The residual cannot grow
/// while omega <= 2/(largest eigenvalue), and falls while it is less: where it does not, omega is reduced by
/// a tenth, at most to half of itself: under Coulomb's law it may grow with any omega. Where it grows
/// tenfold, all of these are halved for the rest of the step.
class Jacobi {
 public:
  static constexpr std::string_view name = "jacobi";
  static constexpr bool solves_any_rows = true;
  void begin(Rows& rows, const Points& v, bool fresh);
  Sweep sweep(Rows& rows, Points& v, BlockSeconds seconds);
  double factor() const { return omega_; }  // omega of the last linearisation
  void forget() { bound_.forget(); }
  std::int64_t further_sweeps() const { return bound_.sweeps(); }

 private:
  SpectralBound bound_;
  double omega_ = 1, least_omega_ = 0;
  double caution_ = 1;  // factor of omega, for the rest of the step
  double last_residual_ = 0, lowest_residual_ = 0;
  Points next_;
};

}  // namespace pbd
