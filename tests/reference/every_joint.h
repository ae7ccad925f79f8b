// Two bodies with one of each joint.
#pragma once

#include <Eigen/Geometry>

#include "scene.h"

namespace pbd::test {

inline const Vec3 point_a(0.3, -0.2, 0.5), point_b(-0.1, 0.4, 0.2);
inline const Vec3 axis_a = Vec3(1, 2, -1).normalized(), axis_b = Vec3(0.9, 2.1, -0.8).normalized();
inline const Vec3 across_a = axis_a.unitOrthogonal(), across_b = axis_b.unitOrthogonal();
inline const Eigen::Quaterniond turn_a(0.5, -0.5, 0.5, 0.5);
inline const Eigen::Quaterniond turn_b = turn_a * Eigen::Quaterniond(0.9, 0.3, -0.2, 0.1).normalized();

/// Two spinning bodies and a node with one of each joint, none in a special place.
inline Scene every_joint(double compliance) {
  Scene scene;
  add_body(scene, Vec3(0.1, 0.2, -0.3), 2, Vec3(0.3, 0.4, 0.5), turn_a, Vec3(0.3, 0.1, 0), Vec3(1, -2, 0.5));
  add_body(scene, Vec3(1.1, -0.4, 0.2), 1, Vec3(0.1, 0.12, 0.2), turn_b, Vec3(0, -0.2, 1), Vec3(-1, 2, 3));
  add_node(scene, Vec3(0.5, 0.6, 0.7), 0.3, Vec3(1, 0, 0));
  const std::vector<std::array<int, 2>> pair{{0, 1}};
  const std::vector<std::array<Vec3, 2>> points{{point_a, point_b}}, axes{{axis_a, axis_b}};
  const std::vector<double> soft{compliance};
  scene.effects = {Gravity{},
                   Gyroscopic{},
                   ExternalTorque{{0}, {Vec3(0.3, -0.2, 0.1)}},
                   PointJoint{pair, points, soft},
                   AxisJoint{pair, axes, soft},
                   PerpendicularJoint{pair, axes, soft},
                   RotationJoint{pair, {Eigen::Quaterniond(0.8, 0.1, 0.5, -0.2).normalized()}, soft},
                   LineJoint{pair, points, {axis_a}, soft},
                   BodyDistance{pair, points, {0.7}, soft},
                   AngleJoint{pair, {axis_a}, {{across_a, across_b}}, {0.2}, {0.3}, soft},
                   SlideJoint{pair, points, {axis_a}, {0.1}, {0.2}, soft},
                   Attachment{{0}, {2}, {point_a}, soft},
                   Distance{{{1, 2}}, {0.8}, soft}};
  scene.initial.time = 2;
  return scene;
}

}  // namespace pbd::test
