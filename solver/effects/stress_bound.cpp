#include "effects/stress_bound.h"

#include "rows/symmetric_eigen.h"

namespace pbd {
namespace {

template <class Gradients, class Square>
auto stiffness(const Gradients& y, const Square& stress) {
  const auto eigen = symmetric_eigen(stress);
  const Gradients directions = y * eigen.vectors;
  const auto tension = eigen.values.cwiseMax(0.0).eval();
  return (directions * tension.asDiagonal() * directions.transpose()).eval();
}

}  // namespace

Eigen::Matrix3d stress_stiffness(const Eigen::Matrix<double, 3, 2>& y, const Eigen::Matrix2d& stress) {
  return stiffness(y, stress);
}

Eigen::Matrix<double, 1, 3> stress_bound(const Eigen::Matrix<double, 3, 2>& y,
                                         const Eigen::Matrix2d& stress) {
  return stiffness(y, stress).cwiseAbs().rowwise().sum().transpose();
}

Eigen::Matrix<double, 1, 4> stress_bound(const Eigen::Matrix<double, 4, 3>& y,
                                         const Eigen::Matrix3d& stress) {
  return stiffness(y, stress).cwiseAbs().rowwise().sum().transpose();
}

}  // namespace pbd
