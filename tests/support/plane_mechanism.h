// Bodies hinged in the plane x-y, to make mechanisms of.
#pragma once

#include "body_scenes.h"

namespace pbd::test {

/// Bodies hinged about z at points of the world.
struct PlaneMechanism {
  Scene scene;
  PointJoint points{};
  AxisJoint axes{};
  int world = -1;

  PlaneMechanism() : world(add_world(scene)) {}

  /// A body whose frame is turned by `angle` about z; moment about z.
  int body(double x, double y, double angle, double mass, double moment, const Vec3& velocity = Vec3::Zero(),
           double spin = 0) {
    return add_body(scene, Vec3(x, y, 0), mass, Vec3(moment / 2, moment, moment),
                    Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vec3::UnitZ())), velocity, Vec3(0, 0, spin));
  }
  /// A point (m) of the world in a body's frame.
  Vec3 own(int body, double x, double y) const {
    const int node = scene.bodies[static_cast<std::size_t>(body)].node;
    return scene.initial.orientation[static_cast<std::size_t>(body)].conjugate() *
           (Vec3(x, y, 0) - scene.initial.x.col(node));
  }
  void hinge(int a, int b, double x, double y) {
    join(points, a, b, own(a, x, y), own(b, x, y));
    axes.body.push_back({a, b});
    axes.axis.push_back({Vec3::UnitZ(), Vec3::UnitZ()});
    axes.compliance.push_back(0);
  }
  Scene finished() {
    scene.effects.insert(scene.effects.end(), {Gyroscopic{}, points, axes});
    return scene;
  }
};

}  // namespace pbd::test
