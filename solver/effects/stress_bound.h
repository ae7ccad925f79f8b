// Y P Y^T, P the positive part of the symmetric matrix `stress`: where a constraint's value is F^T F
// contracted with -stress, F = X Y, this is its geometric stiffness under tension, one number a pair of
// nodes, and the row sums of its absolute values are its geometric bound (rows/constraint.h).
#pragma once

#include <Eigen/Core>

namespace pbd {

Eigen::Matrix3d stress_stiffness(const Eigen::Matrix<double, 3, 2>& y, const Eigen::Matrix2d& stress);
Eigen::Matrix<double, 1, 3> stress_bound(const Eigen::Matrix<double, 3, 2>& y, const Eigen::Matrix2d& stress);
Eigen::Matrix<double, 1, 4> stress_bound(const Eigen::Matrix<double, 4, 3>& y, const Eigen::Matrix3d& stress);

}  // namespace pbd
