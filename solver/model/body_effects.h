// Effects on rigid bodies: given torques, joints, and nodes held by bodies (scene.h says what all constraints
// share).
#pragma once

#include <string_view>

#include "geometry.h"

namespace pbd {

/// Constant torques on rigid bodies, N m in the world's axes, as they are where a step begins.
struct ExternalTorque {
  static constexpr std::string_view name = "external_torque";
  std::vector<int> body;
  std::vector<Vec3> torque;
};

/// The torque -w x I w that turns a rigid body's angular velocity w; without it, w stays as it is in the
/// body's frame. Explicit: as it is where a step begins. Implicit: where its forces act, as those of
/// constraints do.
struct Gyroscopic {
  static constexpr std::string_view name = "gyroscopic";
  bool implicit = true;
};

// Joints of two rigid bodies a, b: points p (m) and unit axes u are given in the bodies' frames, y = x + R p
// and R u are theirs in the world. Each removes what its value states; a hinge is a point_joint and an
// axis_joint, a slider a line_joint and a rotation_joint, a universal joint a point_joint and a
// perpendicular_joint, a weld a point_joint and a rotation_joint. A body of infinite mass and inertia stands
// for the world.

/// Bounds of the force gamma (N, or N m) of a constraint of one row: where gamma is at the lower one, c may
/// be positive, at the upper one negative. {0, infinity} is a limit from below, c >= 0; {-t, t} a motor of
/// at most t N m.
using ForceBounds = std::array<double, 2>;

/// c = y_b - y_a (3 rows, m), in body a's frame if damped. Compliance in m/N.
struct PointJoint {
  static constexpr std::string_view name = "point_joint";
  std::vector<std::array<int, 2>> body;
  std::vector<std::array<Vec3, 2>> point;
  std::vector<double> compliance;
  std::vector<double> damping{};
};

/// c = t . R_b u_b for two unit vectors t of body a, at right angles to u_a and each other (2 rows, rad where
/// small): the axes are parallel. Compliance in rad/(N m).
struct AxisJoint {
  static constexpr std::string_view name = "axis_joint";
  std::vector<std::array<int, 2>> body;
  std::vector<std::array<Vec3, 2>> axis;
  std::vector<double> compliance;
  std::vector<double> damping{};
};

/// c = R_a u_a . R_b u_b (1 row, rad where small): the axes are at right angles.
struct PerpendicularJoint {
  static constexpr std::string_view name = "perpendicular_joint";
  std::vector<std::array<int, 2>> body;
  std::vector<std::array<Vec3, 2>> axis;
  std::vector<double> compliance;
  std::vector<double> damping{};
};

/// c = 2 vec(r^-1 q_a^-1 q_b), its scalar part not negative (3 rows, rad where small): the orientation of b
/// in a's frame is r.
struct RotationJoint {
  static constexpr std::string_view name = "rotation_joint";
  std::vector<std::array<int, 2>> body;
  std::vector<Eigen::Quaterniond> rest;
  std::vector<double> compliance;
  std::vector<double> damping{};
};

/// c = t . (y_b - y_a) for two unit vectors t of body a, at right angles to the axis u_a and each other (2
/// rows, m): y_b stays on the line through y_a along u_a.
struct LineJoint {
  static constexpr std::string_view name = "line_joint";
  std::vector<std::array<int, 2>> body;
  std::vector<std::array<Vec3, 2>> point;
  std::vector<Vec3> axis;  // u_a
  std::vector<double> compliance;
  std::vector<double> damping{};
};

/// c = |y_b - y_a| - rest_length (1 row, m).
struct BodyDistance {
  static constexpr std::string_view name = "body_distance";
  std::vector<std::array<int, 2>> body;
  std::vector<std::array<Vec3, 2>> point;
  std::vector<double> rest_length;
  std::vector<double> compliance;
  std::vector<double> damping{};
  std::vector<ForceBounds> bounds{};  // empty: none
};

/// c = angle - (rest_angle + rate t) modulo 2 pi, in (-pi, pi] where a step begins, from where it goes on in
/// the step (1 row, rad): the angle that body b is turned by about a's axis u_a, from the reference direction
/// of a to that of b, both at right angles to the axis. With compliance a spring; a rate (rad/s) makes it a
/// motor.
struct AngleJoint {
  static constexpr std::string_view name = "angle_joint";
  std::vector<std::array<int, 2>> body;
  std::vector<Vec3> axis;                      // u_a
  std::vector<std::array<Vec3, 2>> reference;  // unit vectors
  std::vector<double> rest_angle;
  std::vector<double> rate;
  std::vector<double> compliance;
  std::vector<double> damping{};
  std::vector<ForceBounds> bounds{};  // empty: none
};

/// c = R_a u_a . (y_b - y_a) - (rest_position + rate t) (1 row, m). With compliance a spring; a rate (m/s)
/// makes it a motor.
struct SlideJoint {
  static constexpr std::string_view name = "slide_joint";
  std::vector<std::array<int, 2>> body;
  std::vector<std::array<Vec3, 2>> point;
  std::vector<Vec3> axis;  // u_a
  std::vector<double> rest_position;
  std::vector<double> rate;
  std::vector<double> compliance;
  std::vector<double> damping{};
  std::vector<ForceBounds> bounds{};  // empty: none
};

/// c = x_node - y (3 rows, m), in the body's frame if damped: a node held by a point of a rigid body.
struct Attachment {
  static constexpr std::string_view name = "attachment";
  std::vector<int> body;
  std::vector<int> node;
  std::vector<Vec3> point;
  std::vector<double> compliance;
  std::vector<double> damping{};
};

}  // namespace pbd
