#include <Eigen/Dense>

#include "effect_rows.h"

namespace pbd {
namespace {

template <class Square>
Square inverse(const Square& n, bool& singular) {
  singular = false;
  const Eigen::LLT<Square> factor(n);
  constexpr double definite = 1e-14;  // smallest pivot against the largest entry
  if (factor.info() == Eigen::Success &&
      factor.matrixLLT().diagonal().array().square().minCoeff() > definite * n.diagonal().maxCoeff())
    return factor.solve(Square::Identity());
  singular = true;
  const Eigen::SelfAdjointEigenSolver<Square> eigen(n);
  const double cut = definite * eigen.eigenvalues().cwiseAbs().maxCoeff();
  const auto reciprocal = (eigen.eigenvalues().array() > cut).select(1 / eigen.eigenvalues().array(), 0.0);
  return eigen.eigenvectors() * reciprocal.matrix().asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

Eigen::Matrix2d invert(const Eigen::Matrix2d& n, bool& singular) {
  return inverse(n, singular);
}

Eigen::Matrix3d invert(const Eigen::Matrix3d& n, bool& singular) {
  return inverse(n, singular);
}

Eigen::Matrix<double, 6, 6> invert(const Eigen::Matrix<double, 6, 6>& n, bool& singular) {
  return inverse(n, singular);
}

}  // namespace pbd
