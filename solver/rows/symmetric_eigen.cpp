#include "rows/symmetric_eigen.h"

#include <Eigen/Eigenvalues>

namespace pbd {
namespace {

template <int N>
SymmetricEigen<N> decomposed(const Eigen::Matrix<double, N, N>& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> eigen(symmetric);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

}  // namespace

SymmetricEigen<2> symmetric_eigen(const Eigen::Matrix2d& symmetric) {
  return decomposed(symmetric);
}

SymmetricEigen<3> symmetric_eigen(const Eigen::Matrix3d& symmetric) {
  return decomposed(symmetric);
}

Eigen::Vector3d symmetric_eigenvalues(const Eigen::Matrix3d& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}

double largest_eigenvalue(const Eigen::Matrix3d& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>()
      .computeDirect(symmetric, Eigen::EigenvaluesOnly)
      .eigenvalues()[2];
}

SymmetricEigen<6> symmetric_eigen(const Eigen::Matrix<double, 6, 6>& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(symmetric);  // of any size: it is rare
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

}  // namespace pbd
