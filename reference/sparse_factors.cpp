#include <Eigen/CholmodSupport>
#include <Eigen/SPQRSupport>
#include <Eigen/UmfPackSupport>
#include <algorithm>

#include "sparse.h"

namespace pbd::reference {

std::vector<int> independent_rows(const SparseMatrix& matrix, double threshold) {
  std::vector<int> rows;
  if (matrix.rows() == 0) return rows;
  SparseMatrix transposed = matrix.transpose();
  transposed.makeCompressed();
  Eigen::SPQR<SparseMatrix> qr;
  qr.setPivotThreshold(threshold);
  qr.compute(transposed);
  const auto permutation = qr.colsPermutation();
  for (int i = 0; i < qr.rank(); ++i) rows.push_back(static_cast<int>(permutation.indices()(i)));
  std::sort(rows.begin(), rows.end());
  return rows;
}

Vector least_squares(const SparseMatrix& a, const Vector& b) {
  Eigen::SPQR<SparseMatrix> qr;
  qr.compute(a);
  return qr.solve(b);
}

struct SparseLu::Factor {
  Eigen::UmfPackLU<SparseMatrix> lu;
};

SparseLu::SparseLu() : factor_(std::make_unique<Factor>()) {}
SparseLu::~SparseLu() = default;

bool SparseLu::compute(const SparseMatrix& a) {
  factor_->lu.compute(a);
  return factor_->lu.info() == Eigen::Success;
}
Vector SparseLu::solve(const Vector& b) const {
  return factor_->lu.solve(b);
}

struct SparseCholesky::Factor {
  Eigen::CholmodSupernodalLLT<SparseMatrix> llt;
  bool analysed = false;
};

SparseCholesky::SparseCholesky() : factor_(std::make_unique<Factor>()) {
  factor_->llt.cholmod().print = 0;
  factor_->llt.cholmod().quick_return_if_not_posdef = 1;
}
SparseCholesky::~SparseCholesky() = default;

bool SparseCholesky::compute(const SparseMatrix& a) {
  if (!factor_->analysed) factor_->llt.analyzePattern(a);
  factor_->analysed = true;
  factor_->llt.factorize(a);
  return factor_->llt.info() == Eigen::Success;
}
Vector SparseCholesky::solve(const Vector& b) const {
  return factor_->llt.solve(b);
}
Eigen::MatrixXd SparseCholesky::solve(const Eigen::MatrixXd& b) const {
  return factor_->llt.solve(b);
}

}  // namespace pbd::reference
