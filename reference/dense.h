// Dense linear algebra of small matrices. Each of Eigen's products and decompositions of matrices of dynamic
// size is compiled once, in dense_*.cpp.
#pragma once

#include <Eigen/Core>

namespace pbd::reference {

/// A B, A^T B, A B^T, and B^T A B.
Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
Eigen::MatrixXd transposed_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
Eigen::MatrixXd product_transposed(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
Eigen::MatrixXd congruence(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// Of a square matrix, in no order.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& a);

/// Ascending values, and unit vectors of a symmetric matrix, one column each.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& a);
/// A x = lambda B x with symmetric A and positive definite B; x^T B x = 1.
SymmetricEigen generalised_eigen(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
Eigen::VectorXd generalised_eigenvalues(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// A^-1 b and A^-1 of a regular A, by LU with partial pivoting.
Eigen::VectorXd solve(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
Eigen::MatrixXd solve(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
Eigen::MatrixXd inverse(const Eigen::MatrixXd& a);
/// A^-1 b of a symmetric positive definite A, by Cholesky.
Eigen::VectorXd solve_definite(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
Eigen::MatrixXd solve_definite(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// A^-1 b of a symmetric semidefinite A, by L D L^T with pivoting.
Eigen::VectorXd solve_semidefinite(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// Orthonormal basis of the null space of a wide matrix, one column a direction; pivots below `threshold` of
/// the largest count as zero.
Eigen::MatrixXd null_space(const Eigen::MatrixXd& rows, double threshold);

/// The x of least 2-norm that makes |A x - b| smallest, and the rank that A then has.
struct LeastSquares {
  Eigen::VectorXd x;
  int rank;
};
LeastSquares least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, double threshold);

}  // namespace pbd::reference
