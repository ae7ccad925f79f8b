// Joints that hold directions of bodies.
#include <numbers>

#include "effects/joint_parts.h"
#include "effects/joints.h"

namespace pbd {
namespace {

/// Bounds of u . w, u a direction of body a times the impulse, w one of b.
Eigen::RowVector4d product_of_directions(const Vec3& u, const Vec3& w, const Pose& a, const Pose& b) {
  return rotation_bound(lever_form(u, w), w.cross(u), a, b);
}

}  // namespace

void Constraint<AxisJoint>::evaluate(const AxisJoint& effect, std::size_t i, const Positions& at,
                                     Value& value, Jacobian& jacobian) {
  const Pose &a = *at.body[0], &b = *at.body[1];
  const Eigen::Matrix<double, 3, 2> normals = a.rotation * normals_of(effect.axis[i][0]);
  const Vec3 axis = b.rotation * effect.axis[i][1];
  for (int k = 0; k < 2; ++k) {
    const Vec3 normal = normals.col(k), turn = normal.cross(axis);
    value[k] = normal.dot(axis);
    jacobian.row(k) << Row3::Zero(), turn.transpose() * a.turning, Row3::Zero(),
        -turn.transpose() * b.turning;
  }
}

Constraint<AxisJoint>::NodeBounds Constraint<AxisJoint>::geometric_bound(const AxisJoint& effect,
                                                                         std::size_t i, const Positions& at,
                                                                         const Value& impulse) {
  const Pose &a = *at.body[0], &b = *at.body[1];
  return product_of_directions(a.rotation * normals_of(effect.axis[i][0]) * impulse,
                               b.rotation * effect.axis[i][1], a, b);
}

void Constraint<PerpendicularJoint>::evaluate(const PerpendicularJoint& effect, std::size_t i,
                                              const Positions& at, Value& value, Jacobian& jacobian) {
  const Pose &a = *at.body[0], &b = *at.body[1];
  const Vec3 axis_a = a.rotation * effect.axis[i][0], axis_b = b.rotation * effect.axis[i][1];
  const Vec3 turn = axis_a.cross(axis_b);
  value[0] = axis_a.dot(axis_b);
  jacobian << Row3::Zero(), turn.transpose() * a.turning, Row3::Zero(), -turn.transpose() * b.turning;
}

Constraint<PerpendicularJoint>::NodeBounds Constraint<PerpendicularJoint>::geometric_bound(
    const PerpendicularJoint& effect, std::size_t i, const Positions& at, const Value& impulse) {
  const Pose &a = *at.body[0], &b = *at.body[1];
  return product_of_directions(impulse[0] * (a.rotation * effect.axis[i][0]), b.rotation * effect.axis[i][1],
                               a, b);
}

namespace {

/// Rotation error of b, and dc/dphi_b of c = 2 vec(error).
struct Turned {
  Eigen::Quaterniond error;
  Eigen::Matrix3d by_phi;

  Turned(const RotationJoint& effect, std::size_t i, const Pose& a, const Pose& b)
      : error(Eigen::Matrix3d(effect.rest[i].toRotationMatrix().transpose() * a.rotation.transpose() *
                              b.rotation)) {
    if (error.w() < 0) error.coeffs() *= -1;
    by_phi = (error.w() * Eigen::Matrix3d::Identity() + cross_matrix(error.vec())) * b.rotation.transpose();
  }
};

}  // namespace

void Constraint<RotationJoint>::evaluate(const RotationJoint& effect, std::size_t i, const Positions& at,
                                         Value& value, Jacobian& jacobian) {
  const Pose &a = *at.body[0], &b = *at.body[1];
  const Turned turned(effect, i, a, b);
  value = 2 * turned.error.vec();
  jacobian << Square::Zero(), -turned.by_phi * a.turning, Square::Zero(), turned.by_phi * b.turning;
}

/// Of b's rotation alone 2 vec(q) has the second derivative -vec(q) |phi|^2 / 2.
Constraint<RotationJoint>::NodeBounds Constraint<RotationJoint>::geometric_bound(const RotationJoint& effect,
                                                                                 std::size_t i,
                                                                                 const Positions& at,
                                                                                 const Value& impulse) {
  const Pose &a = *at.body[0], &b = *at.body[1];
  const Turned turned(effect, i, a, b);
  return rotation_bound(impulse.dot(turned.error.vec()) / 2 * Square::Identity(),
                        turned.by_phi.transpose() * impulse, a, b);
}

namespace {

/// The angle of b's reference `to` about a's axis from a's reference, and its derivative by `to`.
struct Twist {
  Vec3 to, across;  // across: to without its part along the axis
  double squared;   // |across|^2
  Vec3 gradient;    // axis x across / |across|^2
  double angle;

  Twist(const AngleJoint& effect, std::size_t i, const Pose& a, const Pose& b)
      : to(b.rotation * effect.reference[i][1]) {
    const Vec3 axis = a.rotation * effect.axis[i], from = a.rotation * effect.reference[i][0];
    angle = std::atan2(axis.dot(from.cross(to)), from.dot(to));
    across = to - axis.dot(to) * axis;
    squared = across.squaredNorm();
    gradient = squared > 0 ? Vec3(axis.cross(across) / squared) : Vec3(Vec3::Zero());
  }
};

}  // namespace

void Constraint<AngleJoint>::evaluate(const AngleJoint& effect, std::size_t i, const Positions& at,
                                      Value& value, Jacobian& jacobian) {
  const Pose &a = *at.body[0], &b = *at.body[1];
  const Twist twist(effect, i, a, b);
  value[0] =
      std::remainder(twist.angle - effect.rest_angle[i] - effect.rate[i] * at.time, 2 * std::numbers::pi);
  const Vec3 turn = twist.squared > 0 ? twist.to.cross(twist.gradient) : Vec3(a.rotation * effect.axis[i]);
  jacobian << Row3::Zero(), -turn.transpose() * a.turning, Row3::Zero(), turn.transpose() * b.turning;
}

/// With g = across and t = gradient the angle's second derivative by `to` is -(g t^T + t g^T) / |g|^2.
Constraint<AngleJoint>::NodeBounds Constraint<AngleJoint>::geometric_bound(const AngleJoint& effect,
                                                                           std::size_t i, const Positions& at,
                                                                           const Value& impulse) {
  const Pose &a = *at.body[0], &b = *at.body[1];
  const Twist twist(effect, i, a, b);
  if (!(twist.squared > 0)) return NodeBounds::Zero();
  const Eigen::Matrix3d product = twist.across * twist.gradient.transpose(), turn = cross_matrix(twist.to);
  const Eigen::Matrix3d by_turn = turn.transpose() * (product + product.transpose()) * turn / twist.squared;
  return rotation_bound(impulse[0] * by_turn + lever_form(impulse[0] * twist.gradient, twist.to),
                        impulse[0] * twist.to.cross(twist.gradient), a, b);
}

}  // namespace pbd
