// What touches what in a step, by formulas of a judge's own: spheres and corners of boxes on spheres and half
// spaces.
#pragma once

#include "rigid_step.h"

namespace pbd::reference {

/// What touches of a body: a point rounded by a radius, or a plane through it.
struct Feature {
  int body = 0;
  Vec3 point = Vec3::Zero();  // m, in the body's frame, as is the normal of a plane
  double radius = 0;          // m
  bool plane = false;
  Vec3 normal = Vec3::UnitZ();
};

struct Touch {
  Feature a, b;  // a is no plane
  double friction = 0;
  bool slides = false;
  Vec3 across = Vec3::UnitX();  // some direction across the normal
  std::size_t lowest = 0;       // of the touches of its pair, by its number
};

struct TouchingAt {
  double gap = 0;
  Eigen::Matrix3d directions;  // in rows: the normal from b to a, two tangents
  Vec3 point_a, point_b;       // m, what touches
};

/// A point of the world in a body's frame, m.
Vec3 seen_by(const RigidStep& step, const Placement& at, int body, const Vec3& point);

/// The feature of a collider that is nearest to a point of its body's frame. Throws SetupError for other
/// shapes.
Feature feature_of(const Collider& collider, const Vec3& seen);

TouchingAt touching_at(const RigidStep& step, const Placement& at, const Touch& touch);

/// Velocities of a against b at `place` along a touch's directions, by the unknowns' (turns as the bodies
/// stand).
Eigen::MatrixXd rows_of(const RigidStep& step, const Placement& at, const Touch& touch,
                        const TouchingAt& found, const Vec3& place);

}  // namespace pbd::reference
