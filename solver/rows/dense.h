// Decompositions of small dense matrices, compiled once.
#pragma once

#include <Eigen/Core>

namespace pbd {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Matrix1d = Eigen::Matrix<double, 1, 1>;

/// A^-1 c, A positive definite.
Eigen::Vector2d solve_definite(const Eigen::Matrix2d& a, const Eigen::Vector2d& c);
Eigen::Vector3d solve_definite(const Eigen::Matrix3d& a, const Eigen::Vector3d& c);
Eigen::Matrix<double, 6, 1> solve_definite(const Matrix6d& a, const Eigen::Matrix<double, 6, 1>& c);
Matrix1d solve_definite(const Matrix1d& a, const Matrix1d& c);

/// b <- A^-1 b, A positive definite with at most 6 rows.
void solve_definite_in_place(const Eigen::Ref<const Eigen::MatrixXd>& a, Eigen::Ref<Eigen::MatrixXd> b);

/// A^-1 of a regular matrix.
Eigen::Matrix2d inverse_of(const Eigen::Matrix2d& a);
Eigen::Matrix3d inverse_of(const Eigen::Matrix3d& a);
Matrix6d inverse_of(const Matrix6d& a);
inline Matrix1d inverse_of(const Matrix1d& a) {
  return Matrix1d(1 / a(0, 0));
}

/// Solution of a x = b by Gaussian elimination with full pivoting.
Eigen::Vector3d solve(const Eigen::Matrix3d& a, const Eigen::Vector3d& b);

}  // namespace pbd
