// What joints are made of: points and directions of rigid bodies, their derivatives by a rotation phi of the
// body as it stands, and bounds of their second derivatives.
//   lever      s = R p,  ds/dphi = -[s]x,  phi^T s'' phi = phi x (phi x s)
//   direction  u = R u0, likewise
// Bounds are by the columns (dx, r w) of constraint.h, with phi = turn_per_arc arc.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "rows/constraint.h"
#include "rows/source.h"
#include "rows/wandered.h"

namespace pbd {

using Row3 = Eigen::RowVector3d;

/// What all joints state alike.
template <class Joint, int R, int B = 2, int P = 0>
struct JointConstraint : BodyConstraintShape<R, B, P> {
  using Square = typename ConstraintShape<R, 2 * B + P>::Square;

  static std::array<int, B> body(const Joint& effect, std::size_t i) { return {effect.body[i]}; }
  static double compliance_scale(const Joint& effect, std::size_t i) { return effect.compliance[i]; }
  static Square retardation(const Joint& effect, std::size_t i) {
    return effect.damping[i] * Square::Identity();
  }
};

/// Two unit vectors at right angles to the unit vector `axis` and each other.
inline Eigen::Matrix<double, 3, 2> normals_of(const Vec3& axis) {
  Eigen::Matrix<double, 3, 2> normals;
  normals.col(0) = axis.unitOrthogonal();
  normals.col(1) = axis.cross(normals.col(0));
  return normals;
}

/// S with phi^T S phi = -p . (phi x (phi x s)), p an impulse (or its opposite) on the lever s.
inline Eigen::Matrix3d lever_form(const Vec3& p, const Vec3& s) {
  const Eigen::Matrix3d product = p * s.transpose();
  return p.dot(s) * Eigen::Matrix3d::Identity() - (product + product.transpose()) / 2;
}

/// Largest of phi^T S phi, S symmetric, for an arc of 1 m; 0 if all are negative.
double largest_of(const Eigen::Matrix3d& form, const Pose& pose);

/// Bound of phi_a^T C phi_b for arcs of 1 m.
inline double product_bound(const Pose& a, const Eigen::Matrix3d& product, const Pose& b) {
  return (a.turn_per_arc.transpose() * product * b.turn_per_arc).norm();
}

/// Bounds of a constraint of the rotation between two bodies, whose impulses give b the torque m (a its
/// opposite) and have the form S of b's rotations alone. A rotation of b by phi_b and of a by phi_a is one
/// of b by phi_b - phi_a - phi_a x phi_b / 2, so that the form of both is
///   (phi_b - phi_a)^T S (phi_b - phi_a) + m . (phi_a x phi_b)
inline Eigen::RowVector4d rotation_bound(const Eigen::Matrix3d& form, const Vec3& torque, const Pose& a,
                                         const Pose& b) {
  const double across = product_bound(a, form, b) + product_bound(a, cross_matrix(torque), b) / 2;
  return {0, largest_of(form, a) + across, 0, largest_of(form, b) + across};
}

/// Bounds of u . w, u a direction of body a times the impulse, w one of b.
inline Eigen::RowVector4d product_of_directions(const Vec3& u, const Vec3& w, const Pose& a, const Pose& b) {
  return rotation_bound(lever_form(u, w), w.cross(u), a, b);
}

/// c = t . (y - x_a), t a vector of body a, y = x_b + R_b p_b: value, row of the Jacobian, bound.
struct Slide {
  Vec3 direction, gap, lever;  // t, y - x_a, R_b p_b

  Slide(const Pose& a, const Pose& b, const Vec3& own_direction, const Vec3& point)
      : direction(a.rotation * own_direction), lever(b.rotation * point) {
    gap = b.x + lever - a.x;
  }

  double value() const { return direction.dot(gap); }

  Eigen::Matrix<double, 1, 12> jacobian(const Pose& a, const Pose& b) const {
    Eigen::Matrix<double, 1, 12> row;
    row << -direction.transpose(), direction.cross(gap).transpose() * a.turn_per_arc, direction.transpose(),
        lever.cross(direction).transpose() * b.turn_per_arc;
    return row;
  }

  /// Forms of a's rotation of t and of b's of its lever, and -2 p (phi_a x t) . (dx_b - dx_a + phi_b x lever)
  /// split evenly.
  Eigen::RowVector4d bound(double p, const Pose& a, const Pose& b) const {
    const Eigen::Matrix3d turn = cross_matrix(direction);
    const double along = std::abs(p) * (turn * a.turn_per_arc).norm();
    const double across = std::abs(p) * product_bound(a, turn.transpose() * cross_matrix(lever), b);
    return {along, largest_of(lever_form(p * gap, direction), a) + 2 * along + across, along,
            largest_of(lever_form(p * direction, lever), b) + across};
  }
};

}  // namespace pbd
