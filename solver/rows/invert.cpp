#include "rows/invert.h"

#include <Eigen/Cholesky>

#include "rows/symmetric_eigen.h"

namespace pbd {
namespace {

constexpr double definite = 1e-14;  // smallest pivot against the largest entry, some tens of its rounding

template <class Square, class Eigenvalues, class Eigenvectors>
Square pseudo_inverse(const Eigenvalues& values, const Eigenvectors& vectors) {
  const double cut = definite * values.cwiseAbs().maxCoeff();
  const auto reciprocal = (values.array() > cut).select(1 / values.array(), 0.0);
  return vectors * reciprocal.matrix().asDiagonal() * vectors.transpose();
}

/// The inverse by Cholesky's factors; false where there is none.
template <class Square>
bool inverted(const Square& n, Square& inverse) {
  const Eigen::LLT<Square> factor(n);
  if (factor.info() != Eigen::Success ||
      !(factor.matrixLLT().diagonal().array().square().minCoeff() > definite * n.diagonal().maxCoeff()))
    return false;
  inverse = factor.solve(Square::Identity());
  return true;
}

template <class Square>
Square invert_small(const Square& n, bool& singular) {
  Square inverse;
  singular = !inverted(n, inverse);
  if (!singular) return inverse;
  const auto eigen = symmetric_eigen(n);
  return pseudo_inverse<Square>(eigen.values, eigen.vectors);
}

}  // namespace

Eigen::Matrix2d invert(const Eigen::Matrix2d& n, bool& singular) {
  return invert_small(n, singular);
}

Eigen::Matrix3d invert(const Eigen::Matrix3d& n, bool& singular) {
  return invert_small(n, singular);
}

Matrix6d invert(const Matrix6d& n, bool& singular) {
  return invert_small(n, singular);
}

}  // namespace pbd
