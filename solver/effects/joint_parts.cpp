#include "effects/joint_parts.h"

#include "rows/symmetric_eigen.h"

namespace pbd {

double largest_of(const Eigen::Matrix3d& form, const Pose& pose) {
  const Eigen::Matrix3d by_arcs = pose.turn_per_arc.transpose() * form * pose.turn_per_arc;
  return std::max(0.0, largest_eigenvalue(by_arcs));
}

}  // namespace pbd
