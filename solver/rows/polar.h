// Rotation R of the polar decomposition F = R S, R always proper (det R = 1), S symmetric.
#pragma once

#include <Eigen/Core>

namespace pbd {

/// Nearest proper rotation to F (3 x 3). Newton's iteration R <- (R + R^-T)/2 (higham1986computing) where F
/// keeps its orientation and is well conditioned; otherwise the singular value decomposition with the sign of
/// the smallest singular value turned, which also serves flat, collapsed and mirrored F.
Eigen::Matrix3d polar_rotation(const Eigen::Matrix3d& f);

}  // namespace pbd
