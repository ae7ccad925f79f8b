#include <Eigen/QR>

#include "dense.h"

namespace pbd::reference {

using Eigen::MatrixXd;

MatrixXd null_space(const MatrixXd& rows, double threshold) {
  Eigen::ColPivHouseholderQR<MatrixXd> qr(rows.transpose());
  qr.setThreshold(threshold);
  const MatrixXd q = qr.householderQ();
  return q.rightCols(rows.cols() - qr.rank());
}

LeastSquares least_squares(const MatrixXd& a, const Eigen::VectorXd& b, double threshold) {
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> decomposition;
  decomposition.setThreshold(threshold);
  decomposition.compute(a);
  return {decomposition.solve(b), static_cast<int>(decomposition.rank())};
}

}  // namespace pbd::reference
