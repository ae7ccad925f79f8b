#include "rows/kept_jacobians.h"

#include "rows/bodies.h"

namespace pbd {
namespace {

/// The diagonal, and the sums of what is opposite.
Eigen::Matrix<double, 6, 1> entries_of(const Eigen::Matrix3d& m) {
  Eigen::Matrix<double, 6, 1> entries;
  entries << m.diagonal(), m(0, 1) + m(1, 0), m(1, 2) + m(2, 1), m(2, 0) + m(0, 2);
  return entries;
}

/// M - [w]x U
Eigen::Matrix3d without_turn(const StrainTurning& turning, const Eigen::Matrix3d& m) {
  return m - cross_matrix(turning.inverse * axial(m)) * turning.stretch;
}

}  // namespace

Eigen::Matrix<double, 6, 12> strain_jacobian(const Eigen::Matrix3d& rest_inverse,
                                             const Eigen::Matrix3d& directions,
                                             const StrainTurning& turning) {
  Eigen::Matrix<double, 6, 12> jacobian;
  const bool turns = !turning.inverse.isZero(0);
  for (int node = 0; node < 3; ++node)
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Matrix3d m = directions.row(axis).transpose() * rest_inverse.row(node);
      jacobian.col(3 + 3 * node + axis) = entries_of(turns ? without_turn(turning, m) : m);
    }
  jacobian.leftCols<3>() = -jacobian.middleCols<3>(3) - jacobian.middleCols<3>(6) - jacobian.rightCols<3>();
  return jacobian;
}

auto StrainJacobians::operator[](std::size_t i) const -> Whole {
  return strain_jacobian(Eigen::Matrix3d::Map(kept_[i].data()).transpose(),
                         Eigen::Matrix3d::Map(kept_[i].data() + 9),
                         turning_.empty() ? StrainTurning{} : turning_[i]);
}

auto StrainJacobians::turning_rate(std::size_t i, const Eigen::Matrix3d& m) const -> Value {
  return entries_of(without_turn(turning_[i], m));
}

Eigen::Matrix3d StrainJacobians::turning_stress(std::size_t i, const Value& p) const {
  const Eigen::Matrix3d stress = symmetric_of(p);
  return stress - cross_matrix(turning_[i].inverse * axial(stress * turning_[i].stretch));
}

}  // namespace pbd
