#include "rows/kept_jacobians.h"

namespace pbd {

auto StrainJacobians::whole(const Eigen::Matrix3d& rest_inverse, const Eigen::Matrix3d& directions,
                            const Turning* turning) -> Whole {
  Whole whole;
  for (int node = 0; node < 3; ++node)
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Matrix3d m = directions.row(axis).transpose() * rest_inverse.row(node);
      auto column = whole.col(3 + 3 * node + axis);
      column << m.diagonal(), m(0, 1) + m(1, 0), m(1, 2) + m(2, 1), m(2, 0) + m(0, 2);
      if (turning != nullptr)
        column -= *turning * Vec3(m(1, 0) - m(0, 1), m(2, 1) - m(1, 2), m(0, 2) - m(2, 0));
    }
  whole.leftCols<3>() = -whole.middleCols<3>(3) - whole.middleCols<3>(6) - whole.rightCols<3>();
  return whole;
}

auto StrainJacobians::operator[](std::size_t i) const -> Whole {
  return whole(Eigen::Matrix3d::Map(kept_[i].data()).transpose(), Eigen::Matrix3d::Map(kept_[i].data() + 9),
               turning_.empty() ? nullptr : &turning_[i]);
}

}  // namespace pbd
