// Sparse factorisations, compiled once.
#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <vector>

namespace pbd {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// The n x n matrix with the sums of these entries.
void assemble(int n, const std::vector<Eigen::Triplet<double>>& entries, SparseMatrix& matrix);

/// L D L^T of a symmetric matrix, of which the lower triangle is read; no pivoting but for fill-in.
class SparseLdlt {
 public:
  SparseLdlt();
  ~SparseLdlt();
  SparseLdlt(SparseLdlt&&) noexcept;
  SparseLdlt& operator=(SparseLdlt&&) noexcept;

  void analyse(const SparseMatrix& matrix);
  /// Of a matrix with the pattern analysed; false where a pivot is zero.
  bool factorise(const SparseMatrix& matrix);
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

/// L U with partial pivoting.
class SparseLu {
 public:
  SparseLu();
  ~SparseLu();
  SparseLu(SparseLu&&) noexcept;
  SparseLu& operator=(SparseLu&&) noexcept;

  /// False where the matrix is singular.
  bool factorise(const SparseMatrix& matrix);
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace pbd
