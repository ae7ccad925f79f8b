// Inverses of semidefinite matrices.
#pragma once

#include "rows/dense.h"

namespace pbd {

/// Inverse of a symmetric positive semidefinite N; its pseudo-inverse, and `singular` set, if it is not
/// definite.
Eigen::Matrix2d invert(const Eigen::Matrix2d& n, bool& singular);
Eigen::Matrix3d invert(const Eigen::Matrix3d& n, bool& singular);
Matrix6d invert(const Matrix6d& n, bool& singular);
inline Matrix1d invert(const Matrix1d& n, bool& singular) {
  singular = !(n(0, 0) > 0);
  return Matrix1d(singular ? 0.0 : 1 / n(0, 0));
}

}  // namespace pbd
