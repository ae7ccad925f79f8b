// Anderson acceleration of a fixed point iteration z <- g(z), z = (v, p): the next iterate is the combination
// of the last images g whose residual f = g(z) - z, measured in the metric M, is least
// (anderson1965iterative, walker2011anderson). With Df, Dg the differences of the last residuals and images,
//   z <- g - Dg gamma,   gamma = argmin |f - Df gamma|_M
// Impulses follow the coefficients of the velocities, and so stay v = v_free + W J^T p where the directions
// do.
#pragma once

#include <Eigen/Core>

#include "rows/rows.h"

namespace pbd {

class Anderson {
 public:
  /// Remembers `memory` differences; none accelerates nothing.
  explicit Anderson(int memory) : memory_(memory) {}

  void forget() { count_ = 0; }

  /// Notes the iterate that the next image comes from.
  void begin(const Rows& rows, const Points& v);

  /// With v and the rows' impulses the image of the noted iterate: replaces them by the accelerated iterate
  /// and returns true, or leaves them as they are: with nothing to combine yet, and where the step would be
  /// non-finite. A step longer than 100 times the image's is shortened to that. The nodes that can move weigh
  /// by their mass.
  bool accelerate(const std::vector<double>& inverse_mass, Rows& rows, Points& v);

  /// Undoes the last acceleration: v and the impulses are the image again. Forgets everything older.
  void reject(Rows& rows, Points& v);

 private:
  void combine(int columns);
  void flatten(const Rows& rows, const Points& v, Eigen::VectorXd& z) const;
  void spread(const Eigen::VectorXd& z, Rows& rows, Points& v) const;

  int memory_;
  int count_ = 0;  // images since the last `forget`
  Eigen::VectorXd start_, image_, last_image_, residual_, last_residual_, root_mass_;
  Eigen::MatrixXd residual_change_, image_change_;  // one column a difference
  Eigen::MatrixXd basis_, triangle_;                // of the residuals' differences
  Eigen::VectorXd coefficient_;
};

}  // namespace pbd
