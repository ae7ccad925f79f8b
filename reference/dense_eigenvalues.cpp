#include <Eigen/Eigenvalues>

#include "dense.h"

namespace pbd::reference {

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& a) {
  return Eigen::EigenSolver<Eigen::MatrixXd>(a, false).eigenvalues();
}

}  // namespace pbd::reference
