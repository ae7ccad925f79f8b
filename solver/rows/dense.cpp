#include "rows/dense.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace pbd {

Matrix1d solve_definite(const Matrix1d& a, const Matrix1d& c) {
  return a.llt().solve(c);
}

Eigen::Vector2d solve_definite(const Eigen::Matrix2d& a, const Eigen::Vector2d& c) {
  return a.llt().solve(c);
}

Eigen::Vector3d solve_definite(const Eigen::Matrix3d& a, const Eigen::Vector3d& c) {
  return a.llt().solve(c);
}

Eigen::Matrix<double, 6, 1> solve_definite(const Matrix6d& a, const Eigen::Matrix<double, 6, 1>& c) {
  return a.llt().solve(c);
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): b is written to
void solve_definite_in_place(const Eigen::Ref<const Eigen::MatrixXd>& a, Eigen::Ref<Eigen::MatrixXd> b) {
  const Eigen::LLT<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>> factor(a);
  factor.solveInPlace(b);
}

Eigen::Matrix2d inverse_of(const Eigen::Matrix2d& a) {
  return a.inverse();
}

Eigen::Matrix3d inverse_of(const Eigen::Matrix3d& a) {
  return a.inverse();
}

Matrix6d inverse_of(const Matrix6d& a) {
  return a.inverse();
}

Eigen::Vector3d solve(const Eigen::Matrix3d& a, const Eigen::Vector3d& b) {
  return a.fullPivLu().solve(b);
}

}  // namespace pbd
