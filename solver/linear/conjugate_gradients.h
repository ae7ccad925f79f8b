// Conjugate gradients on the dual problem, with the impulses that bounds and laws leave free.
#pragma once

#include "linear/sweeps.h"

namespace pbd {

/// Conjugate gradients on the dual problem N p = -(b + J v_free), preconditioned by D = blockdiag(N_ii)
/// (hestenes1952methods, polak1969note). With the direction s and its velocities u = W J^T s kept
/// together, s^T N s = |u|_M^2 + s^T Sigma s needs no further pass: a sweep costs as much as Jacobi's. The
/// residual is taken anew each sweep. Impulses with bounds: those that a step of block Jacobi would leave at
/// a bound take no part; where their set changes, or the step along s is cut at a bound, the next direction
/// begins anew (active sets, as in polyak1969conjugate). Without contacts no step goes beyond the first
/// bound; of many contacts it would reach one a sweep, so that all are cut behind it. Of a sliding contact
/// the normal impulse alone takes part; the others, and an opening one's, are first moved as its law asks:
/// half way between a step of block Jacobi and what the contact alone would do, which by itself may go in
/// circles.
class ConjugateGradients {
 public:
  static constexpr std::string_view name = "conjugate_gradients";
  static constexpr bool solves_any_rows = true;
  void begin(Rows& rows, const Points& v, bool fresh);
  Sweep sweep(Rows& rows, Points& v, BlockSeconds seconds);

 private:
  double length_to_bounds(const Rows& rows) const;
  bool find_free(Rows& rows, Points& v, BlockSeconds seconds, double& squared);

  std::vector<double> direction_, last_;  // s, and the last D^-1 r; one entry a row
  Points velocity_, push_;                // u, and W J^T of the new part of s
  double last_product_ = 0;               // r^T D^-1 r of the last sweep
  double square_ = 0;                     // s^T D s
  enum class Free : std::uint8_t { none, first, all };
  std::vector<Free> free_;  // rows of each constraint with bounds that take part, at its first row's place
};

}  // namespace pbd
