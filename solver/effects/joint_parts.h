// What joints are made of: points and directions of rigid bodies, their derivatives by a rotation phi of the
// body as it stands, and bounds of their second derivatives.
//   lever      s = R p,  ds/dphi = -[s]x,  phi^T s'' phi = phi x (phi x s)
//   direction  u = R u0, likewise
// Bounds are by the columns (dx, r w) of constraint.h: |phi| <= |turning| |arc|.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "effects/constraint.h"

namespace pbd {

using Row3 = Eigen::RowVector3d;

inline Eigen::Matrix3d cross_matrix(const Vec3& a) {
  Eigen::Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

/// Two unit vectors at right angles to the unit vector `axis` and each other.
inline Eigen::Matrix<double, 3, 2> normals_of(const Vec3& axis) {
  Eigen::Matrix<double, 3, 2> normals;
  normals.col(0) = axis.unitOrthogonal();
  normals.col(1) = axis.cross(normals.col(0));
  return normals;
}

/// Largest |phi|^2 of an arc of 1 m, 1/m^2.
inline double turning_squared(const Pose& pose) {
  return pose.turning.colwise().squaredNorm().maxCoeff();
}

/// Bound (times |phi|^2) of -impulse . sign (phi x (phi x s)): the largest eigenvalue of
/// sign ((p.s) I - (p s^T + s p^T)/2).
inline double lever_bound(const Vec3& impulse, double sign, const Vec3& lever) {
  return (impulse.norm() * lever.norm() + sign * impulse.dot(lever)) / 2;
}

/// Bounds of p times a function of two directions' product, whose second derivative by (phi_a, phi_b) is at
/// most (|phi_a| + |phi_b|)^2 <= 2 |phi_a|^2 + 2 |phi_b|^2.
inline Eigen::RowVector4d directions_bound(double impulse, const Pose& a, const Pose& b) {
  return 2 * impulse * Eigen::RowVector4d(0, turning_squared(a), 0, turning_squared(b));
}

/// c = t . (y - x_a), t a direction of body a, y = x_b + R_b p_b: value, row of the Jacobian, bound.
struct Slide {
  Vec3 direction, gap, lever;  // t, y - x_a, R_b p_b

  Slide(const Pose& a, const Pose& b, const Vec3& own_direction, const Vec3& point)
      : direction(a.rotation * own_direction), lever(b.rotation * point) {
    gap = b.x + lever - a.x;
  }

  double value() const { return direction.dot(gap); }

  Eigen::Matrix<double, 1, 12> jacobian(const Pose& a, const Pose& b) const {
    Eigen::Matrix<double, 1, 12> row;
    row << -direction.transpose(), direction.cross(gap).transpose() * a.turning, direction.transpose(),
        lever.cross(direction).transpose() * b.turning;
    return row;
  }

  /// |phi_a|^2 |gap| + 2 |phi_a| (|dx_a| + |dx_b| + |phi_b| |lever|) + |phi_b|^2 |lever|, products split by
  /// the length l.
  Eigen::RowVector4d bound(double impulse, const Pose& a, const Pose& b) const {
    const double ta = turning_squared(a), tb = turning_squared(b);
    const double l = gap.norm() + lever.norm() + 1 / std::sqrt(ta);
    return std::abs(impulse) *
           Eigen::RowVector4d(1 / l, ta * (gap.norm() + 2 * l + lever.norm()), 1 / l, 2 * tb * lever.norm());
  }
};

}  // namespace pbd
