// Joints that hold points of bodies.
#include <Eigen/Eigenvalues>

#include "effects/joint_parts.h"
#include "effects/joints.h"

namespace pbd {

double largest_of(const Eigen::Matrix3d& form, const Pose& pose) {
  const Eigen::Matrix3d by_arcs = pose.turning.transpose() * form * pose.turning;
  return std::max(0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>()
                           .computeDirect(by_arcs, Eigen::EigenvaluesOnly)
                           .eigenvalues()[2]);
}

void Constraint<PointJoint>::evaluate(const PointJoint& effect, std::size_t i, const Positions& at,
                                      Value& value, Jacobian& jacobian) {
  const Pose &a = *at.body[0], &b = *at.body[1];
  const Vec3 lever_a = a.rotation * effect.point[i][0], lever_b = b.rotation * effect.point[i][1];
  value = b.x + lever_b - a.x - lever_a;
  jacobian << -Square::Identity(), cross_matrix(lever_a) * a.turning, Square::Identity(),
      -cross_matrix(lever_b) * b.turning;
}

Constraint<PointJoint>::NodeBounds Constraint<PointJoint>::geometric_bound(const PointJoint& effect,
                                                                           std::size_t i, const Positions& at,
                                                                           const Value& impulse) {
  const Pose &a = *at.body[0], &b = *at.body[1];
  return {0, largest_of(lever_form(-impulse, a.rotation * effect.point[i][0]), a), 0,
          largest_of(lever_form(impulse, b.rotation * effect.point[i][1]), b)};
}

void Constraint<LineJoint>::evaluate(const LineJoint& effect, std::size_t i, const Positions& at,
                                     Value& value, Jacobian& jacobian) {
  const Eigen::Matrix<double, 3, 2> normals = normals_of(effect.axis[i]);
  for (int k = 0; k < 2; ++k) {
    const Slide slide(*at.body[0], *at.body[1], normals.col(k), effect.point[i][1]);
    value[k] = slide.value() - normals.col(k).dot(effect.point[i][0]);
    jacobian.row(k) = slide.jacobian(*at.body[0], *at.body[1]);
  }
}

Constraint<LineJoint>::NodeBounds Constraint<LineJoint>::geometric_bound(const LineJoint& effect,
                                                                         std::size_t i, const Positions& at,
                                                                         const Value& impulse) {
  const Vec3 push = normals_of(effect.axis[i]) * impulse;
  const double size = push.norm();
  const Slide slide(*at.body[0], *at.body[1], size > 0 ? Vec3(push / size) : Vec3(effect.axis[i]),
                    effect.point[i][1]);
  return slide.bound(size, *at.body[0], *at.body[1]);
}

void Constraint<SlideJoint>::evaluate(const SlideJoint& effect, std::size_t i, const Positions& at,
                                      Value& value, Jacobian& jacobian) {
  const Slide slide(*at.body[0], *at.body[1], effect.axis[i], effect.point[i][1]);
  value[0] = slide.value() - effect.axis[i].dot(effect.point[i][0]) - effect.rest_position[i] -
             effect.rate[i] * at.time;
  jacobian = slide.jacobian(*at.body[0], *at.body[1]);
}

Constraint<SlideJoint>::NodeBounds Constraint<SlideJoint>::geometric_bound(const SlideJoint& effect,
                                                                           std::size_t i, const Positions& at,
                                                                           const Value& impulse) {
  const Slide slide(*at.body[0], *at.body[1], effect.axis[i], effect.point[i][1]);
  return slide.bound(impulse[0], *at.body[0], *at.body[1]);
}

namespace {

struct Link {
  Vec3 lever_a, lever_b, direction;
  double length;

  Link(const BodyDistance& effect, std::size_t i, const Pose& a, const Pose& b)
      : lever_a(a.rotation * effect.point[i][0]), lever_b(b.rotation * effect.point[i][1]) {
    const Vec3 link = b.x + lever_b - a.x - lever_a;
    length = link.norm();
    direction = length > 0 ? Vec3(link / length) : Vec3::UnitX();
  }
};

}  // namespace

void Constraint<BodyDistance>::evaluate(const BodyDistance& effect, std::size_t i, const Positions& at,
                                        Value& value, Jacobian& jacobian) {
  const Pose &a = *at.body[0], &b = *at.body[1];
  const Link link(effect, i, a, b);
  value[0] = link.length - effect.rest_length[i];
  jacobian << -link.direction.transpose(), -link.lever_a.cross(link.direction).transpose() * a.turning,
      link.direction.transpose(), link.lever_b.cross(link.direction).transpose() * b.turning;
}

/// |dy_b - dy_a|^2 <= 4 (|dx_a|^2 + |s_a|^2 |phi_a|^2 + ...), over the length, and the levers' own.
Constraint<BodyDistance>::NodeBounds Constraint<BodyDistance>::geometric_bound(const BodyDistance& effect,
                                                                               std::size_t i,
                                                                               const Positions& at,
                                                                               const Value& impulse) {
  const Pose &a = *at.body[0], &b = *at.body[1];
  const Link link(effect, i, a, b);
  const double tension = link.length > 0 ? std::max(0.0, -impulse[0]) * 4 / link.length : 0.0;
  const Vec3 push = impulse[0] * link.direction;
  const auto arc = [&](const Pose& pose, double sign, const Vec3& lever) {
    const Eigen::Matrix3d turn = cross_matrix(lever);
    return largest_of(tension * turn.transpose() * turn + lever_form(sign * push, lever), pose);
  };
  return {tension, arc(a, -1, link.lever_a), tension, arc(b, 1, link.lever_b)};
}

void Constraint<Attachment>::evaluate(const Attachment& effect, std::size_t i, const Positions& at,
                                      Value& value, Jacobian& jacobian) {
  const Pose& body = *at.body[0];
  const Vec3 lever = body.rotation * effect.point[i];
  value = at.node - body.x - lever;
  jacobian << -Square::Identity(), cross_matrix(lever) * body.turning, Square::Identity();
}

Constraint<Attachment>::NodeBounds Constraint<Attachment>::geometric_bound(const Attachment& effect,
                                                                           std::size_t i, const Positions& at,
                                                                           const Value& impulse) {
  const Pose& body = *at.body[0];
  return {0, largest_of(lever_form(-impulse, body.rotation * effect.point[i]), body), 0};
}

}  // namespace pbd
