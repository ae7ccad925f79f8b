#include "rows/polar.h"

#include <Eigen/LU>
#include <Eigen/SVD>

namespace pbd {

Eigen::Matrix3d polar_rotation(const Eigen::Matrix3d& f) {
  constexpr int max_iterations = 20;
  constexpr double well_conditioned = 1e-3;  // of det F against |F|^3
  if (f.determinant() > well_conditioned * f.squaredNorm() * f.norm()) {
    Eigen::Matrix3d rotation = f;
    for (int k = 0; k < max_iterations; ++k) {
      const Eigen::Matrix3d next = 0.5 * (rotation + rotation.inverse().transpose());
      const double change = (next - rotation).squaredNorm();
      rotation = next;
      if (change < 1e-30) return rotation;
    }
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(f, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) *= -1;
  return u * svd.matrixV().transpose();
}

}  // namespace pbd
