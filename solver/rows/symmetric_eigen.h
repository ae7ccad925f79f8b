// Eigenvalues of small symmetric matrices.
#pragma once

#include <Eigen/Core>

namespace pbd {

/// Eigenvalues in rising order and the eigenvectors beside them, of a symmetric matrix.
template <int N>
struct SymmetricEigen {
  Eigen::Matrix<double, N, 1> values;
  Eigen::Matrix<double, N, N> vectors;
};
SymmetricEigen<2> symmetric_eigen(const Eigen::Matrix2d& symmetric);
SymmetricEigen<3> symmetric_eigen(const Eigen::Matrix3d& symmetric);
SymmetricEigen<6> symmetric_eigen(const Eigen::Matrix<double, 6, 6>& symmetric);

/// Eigenvalues alone, in rising order.
Eigen::Vector3d symmetric_eigenvalues(const Eigen::Matrix3d& symmetric);

/// The largest eigenvalue by its closed formula: quicker, to about the root of rounding.
double largest_eigenvalue(const Eigen::Matrix3d& symmetric);

}  // namespace pbd
