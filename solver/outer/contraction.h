// What plain would multiply an error of the iterate by: the spectral radius of
//   -(M + d s J^T A^-1 J)^-1 K,   K = -d sum_i p_i d2c_i,
// on the motions that the rows allow. The effects' bounds where these are small, else Arnoldi's method on the
// error's map (12 vectors in the first step, 3 later, begun with the last one's slowest mode): an estimate
// then, an upper bound below `slow_contraction` and wherever the iteration works on a potential.
#pragma once

#include <cmath>

#include "outer/geometric_mass.h"

namespace pbd {

/// Above this contraction the accelerated proximal iteration is the faster one.
inline constexpr double slow_contraction = 0.7;

class ContractionEstimate {
 public:
  explicit ContractionEstimate(const StepSystem& system);

  /// Estimates it at the iterate; nothing where J is not taken at x. With `bound_alone` the bounds are all
  /// that is asked for.
  void update(StepSystem& system, bool bound_alone, Progress& progress);

  /// Of the last step's end; NaN if nothing is known.
  double value() const { return value_; }

  void forget() {
    value_ = std::nan("");
    mode_known_ = false;
  }

 private:
  static constexpr int most = 12, fewest = 3;  // vectors, in the first step and later ones
  using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most, most>;

  void begin_anywhere(const Problem& problem);
  int project(StepSystem& system, int count, Small& projected, Progress& progress);
  std::int64_t apply_plain(StepSystem& system, Points& error);

  double value_ = std::nan("");
  GeometricMass mass_;
  std::vector<Points> krylov_;  // orthonormal in M; the first one is what plain reduces least, if known
  bool mode_known_ = false;
  Points turned_x_, push_;
  std::vector<Pose> turned_poses_;
  std::vector<double> kept_;
};

}  // namespace pbd
