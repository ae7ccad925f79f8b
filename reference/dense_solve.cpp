#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "dense.h"

namespace pbd::reference {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd solve(const MatrixXd& a, const VectorXd& b) {
  return a.partialPivLu().solve(b);
}
MatrixXd solve(const MatrixXd& a, const MatrixXd& b) {
  return a.partialPivLu().solve(b);
}
MatrixXd inverse(const MatrixXd& a) {
  return a.inverse();
}

VectorXd solve_semidefinite(const MatrixXd& a, const VectorXd& b) {
  return a.ldlt().solve(b);
}

VectorXd solve_definite(const MatrixXd& a, const VectorXd& b) {
  return a.llt().solve(b);
}
MatrixXd solve_definite(const MatrixXd& a, const MatrixXd& b) {
  return a.llt().solve(b);
}

}  // namespace pbd::reference
