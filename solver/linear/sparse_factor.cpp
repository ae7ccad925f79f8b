#include "linear/sparse_factor.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>

namespace pbd {

void assemble(int n, const std::vector<Eigen::Triplet<double>>& entries, SparseMatrix& matrix) {
  matrix.resize(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
}

struct SparseLdlt::Factor : Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower> {};

SparseLdlt::SparseLdlt() : factor_(std::make_unique<Factor>()) {}
SparseLdlt::~SparseLdlt() = default;
SparseLdlt::SparseLdlt(SparseLdlt&&) noexcept = default;
SparseLdlt& SparseLdlt::operator=(SparseLdlt&&) noexcept = default;

void SparseLdlt::analyse(const SparseMatrix& matrix) {
  factor_->analyzePattern(matrix);
}

bool SparseLdlt::factorise(const SparseMatrix& matrix) {
  factor_->factorize(matrix);
  return factor_->info() == Eigen::Success;
}

Eigen::VectorXd SparseLdlt::solve(const Eigen::VectorXd& right) const {
  return factor_->solve(right);
}

struct SparseLu::Factor : Eigen::SparseLU<SparseMatrix, Eigen::COLAMDOrdering<int>> {};

SparseLu::SparseLu() : factor_(std::make_unique<Factor>()) {}
SparseLu::~SparseLu() = default;
SparseLu::SparseLu(SparseLu&&) noexcept = default;
SparseLu& SparseLu::operator=(SparseLu&&) noexcept = default;

bool SparseLu::factorise(const SparseMatrix& matrix) {
  factor_->compute(matrix);
  return factor_->info() == Eigen::Success;
}

Eigen::VectorXd SparseLu::solve(const Eigen::VectorXd& right) const {
  return factor_->solve(right);
}

}  // namespace pbd
