// Newton's method for linear rows whose impulses obey bounds and laws of friction: with w =
// `inverse_diagonal` and P what the law makes of a step (rows.h), the rows hold where p = P(p, -w r), r = J v
// + b + Sigma p. Each iteration solves the linear system of (dv, dp)
//   M dv - J^T dp = 0,  (1 - P_p) dp / w + P_step (J dv + Sigma dp) = (P(p, -w r) - p) / w
// (rows without a law: J dv + Sigma dp = -r) by sparse LU, and takes the longest of four steps that reduces
// the residual. Redundant rows make the system singular: Sigma is taken larger by a part of J W J^T, 1e-8 at
// least, a proximal term, which the iteration removes. Where there are more rows than velocities, impulses
// are eliminated (not those of local problems). Where no step reduces the residual the part grows, and
// shrinks again where steps succeed (Levenberg 1944); where none of two does, that of the augmented
// Lagrangian may (augmented.h; where there is none, a third step), or else sweeps of Gauss-Seidel, of
// both the more the longer nothing has been gained. (Semismooth Newton: Qi, Sun 1993; for friction Alart,
// Curnier 1991.)
#pragma once

#include <Eigen/SparseLU>
#include <cstdint>
#include <memory>
#include <vector>

#include "augmented.h"
#include "velocity_system.h"

namespace pbd {

class SemismoothNewton {
 public:
  /// To be called when the rows have changed.
  void begin() {
    lowest_ = infinity;
    idle_ = 0;
    shift_ = least_shift;
    further_sweeps_ = 0;
  }

  /// Improves impulses and v by one iteration; returns the residual (sqrt(J)) it met, or 0 where that has not
  /// fallen for some iterations: nothing left to gain.
  double iterate(Rows& rows, Points& v);

  /// Since `begin`, besides one an iteration: factorisations of the augmented Lagrangian, sweeps of
  /// Gauss-Seidel.
  std::int64_t further_sweeps() const { return further_sweeps_; }

 private:
  static constexpr double least_shift = 1e-8;

  void assemble(const Rows& rows, const Points& v);
  void find_step(const Rows& rows, const Points& v);
  bool descend(Rows& rows, Points& v, double below);

  using Matrix = Eigen::SparseMatrix<double>;
  VelocitySystem system_;
  bool keeps_impulses_ = true;  // as unknowns
  Matrix matrix_;
  using Factor = Eigen::SparseLU<Matrix, Eigen::COLAMDOrdering<int>>;
  std::unique_ptr<Factor> factor_ = std::make_unique<Factor>();
  Eigen::VectorXd right_, solution_, step_;
  AugmentedLagrangian augmented_;
  std::vector<double> kept_;  // impulses and biases, and
  Points start_;              // velocities where the iteration begins
  double lowest_ = infinity;
  int idle_ = 0;                // iterations since the residual was clearly lower than ever
  double shift_ = least_shift;  // of Sigma, as a part of J W J^T
  std::int64_t further_sweeps_ = 0;
};

/// sqrt(sum_i) of the squared residuals of all rows at v.
double natural_residual(const Rows& rows, const Points& v);

}  // namespace pbd
