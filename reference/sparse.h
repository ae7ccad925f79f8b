// Sparse linear algebra, each operation and each factorisation compiled once.
#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <vector>

namespace pbd::reference {

using Vector = Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;
using Triplets = std::vector<Eigen::Triplet<double>>;

/// Entries at the same place are added.
SparseMatrix from_triplets(Eigen::Index rows, Eigen::Index columns, const Triplets& entries);

/// diag(left) A diag(right); A diag(right).
SparseMatrix scaled(const Vector& left, const SparseMatrix& a, const Vector& right);
SparseMatrix scaled(const SparseMatrix& a, const Vector& right);

/// sum_j A_ij^2 w_j of each row i.
Vector squared_rows(const SparseMatrix& a, const Vector& weight);

/// Indices of a largest set of rows, of unit length, that are independent by more than `threshold`,
/// ascending. By SPQR.
std::vector<int> independent_rows(const SparseMatrix& rows, double threshold);

/// The x that makes |A x - b| smallest, by SPQR.
Vector least_squares(const SparseMatrix& a, const Vector& b);

/// A = L U by UMFPACK.
class SparseLu {
 public:
  SparseLu();
  ~SparseLu();
  /// False where A is singular.
  bool compute(const SparseMatrix& a);
  /// A^-1 b; A has to be as it was.
  Vector solve(const Vector& b) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

/// A = L L^T by CHOLMOD's supernodes.
class SparseCholesky {
 public:
  SparseCholesky();
  ~SparseCholesky();
  /// False where A is not positive definite, which is no news. A pattern once analysed is kept: later
  /// matrices have the same.
  bool compute(const SparseMatrix& a);
  Vector solve(const Vector& b) const;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace pbd::reference
