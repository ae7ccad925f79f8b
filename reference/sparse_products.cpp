#include "sparse.h"

namespace pbd::reference {

SparseMatrix from_triplets(Eigen::Index rows, Eigen::Index columns, const Triplets& entries) {
  SparseMatrix matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

SparseMatrix scaled(const Vector& left, const SparseMatrix& a, const Vector& right) {
  return left.asDiagonal() * a * right.asDiagonal();
}
SparseMatrix scaled(const SparseMatrix& a, const Vector& right) {
  return a * right.asDiagonal();
}

Vector squared_rows(const SparseMatrix& a, const Vector& weight) {
  const SparseMatrix squares = a.cwiseProduct(a);
  return squares * weight;
}

}  // namespace pbd::reference
