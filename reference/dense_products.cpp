#include "dense.h"

namespace pbd::reference {

using Eigen::MatrixXd;

MatrixXd product(const MatrixXd& a, const MatrixXd& b) {
  return a * b;
}
MatrixXd transposed_product(const MatrixXd& a, const MatrixXd& b) {
  return a.transpose() * b;
}
MatrixXd product_transposed(const MatrixXd& a, const MatrixXd& b) {
  return a * b.transpose();
}
MatrixXd congruence(const MatrixXd& a, const MatrixXd& b) {
  return b.transpose() * a * b;
}

}  // namespace pbd::reference
