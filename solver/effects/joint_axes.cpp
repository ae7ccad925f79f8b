// Joints that hold directions of bodies.
#include <numbers>

#include "effects/joint_parts.h"
#include "effects/joints.h"

namespace pbd {

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

Constraint<AxisJoint>::NodeBounds Constraint<AxisJoint>::geometric_bound(const AxisJoint&, std::size_t,
                                                                         const Positions& at,
                                                                         const Value& impulse) {
  return directions_bound(impulse.norm(), *at.body[0], *at.body[1]);
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
    const PerpendicularJoint&, std::size_t, const Positions& at, const Value& impulse) {
  return directions_bound(std::abs(impulse[0]), *at.body[0], *at.body[1]);
}

void Constraint<RotationJoint>::evaluate(const RotationJoint& effect, std::size_t i, const Positions& at,
                                         Value& value, Jacobian& jacobian) {
  const Pose &a = *at.body[0], &b = *at.body[1];
  Eigen::Quaterniond error(
      Eigen::Matrix3d(effect.rest[i].toRotationMatrix().transpose() * a.rotation.transpose() * b.rotation));
  if (error.w() < 0) error.coeffs() *= -1;
  value = 2 * error.vec();
  const Square turn = (error.w() * Square::Identity() + cross_matrix(error.vec())) * b.rotation.transpose();
  jacobian << Square::Zero(), -turn * a.turning, Square::Zero(), turn * b.turning;
}

Constraint<RotationJoint>::NodeBounds Constraint<RotationJoint>::geometric_bound(const RotationJoint&,
                                                                                 std::size_t,
                                                                                 const Positions& at,
                                                                                 const Value& impulse) {
  return directions_bound(impulse.norm(), *at.body[0], *at.body[1]);
}

void Constraint<AngleJoint>::evaluate(const AngleJoint& effect, std::size_t i, const Positions& at,
                                      Value& value, Jacobian& jacobian) {
  const Pose &a = *at.body[0], &b = *at.body[1];
  const Vec3 axis = a.rotation * effect.axis[i], from = a.rotation * effect.reference[i][0];
  const Vec3 to = b.rotation * effect.reference[i][1];
  const double angle = std::atan2(axis.dot(from.cross(to)), from.dot(to));
  value[0] = std::remainder(angle - effect.rest_angle[i] - effect.rate[i] * at.time, 2 * std::numbers::pi);
  const Vec3 across = to - axis.dot(to) * axis;
  const double squared = across.squaredNorm();
  const Vec3 turn = squared > 0 ? Vec3(to.cross(axis.cross(across)) / squared) : axis;
  jacobian << Row3::Zero(), -turn.transpose() * a.turning, Row3::Zero(), turn.transpose() * b.turning;
}

Constraint<AngleJoint>::NodeBounds Constraint<AngleJoint>::geometric_bound(const AngleJoint& effect,
                                                                           std::size_t i, const Positions& at,
                                                                           const Value& impulse) {
  const double along =
      (at.body[0]->rotation * effect.axis[i]).dot(at.body[1]->rotation * effect.reference[i][1]);
  const double squared = std::max(1 - along * along, 1e-12);  // |g|^2; the axes are to be parallel: g = f
  return directions_bound(std::abs(impulse[0]) / squared, *at.body[0], *at.body[1]);
}

}  // namespace pbd
