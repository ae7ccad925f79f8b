// Where a scene's masses are: nodes and rigid bodies, and how they move. Units are SI: m, kg, s, rad.
#pragma once

#include "geometry.h"

namespace pbd {

/// Positions x (m) and velocities v (m/s) of all nodes, 3 x N each, at `time` (s). Of each rigid body the
/// orientation, which takes its frame to the world's, and the angular velocity in its own frame (3 x B,
/// rad/s).
struct State {
  double time = 0;
  Points x;
  Points v;
  std::vector<Eigen::Quaterniond> orientation{};
  Points spin = Points(3, 0);
};

/// A rigid body. Its centre of mass is a node of the scene, whose mass is the body's; its frame has its
/// origin there and its axes along the principal axes of inertia. `inertia` holds the principal moments
/// (kg m^2); infinite ones keep the angular velocity as it is.
struct RigidBody {
  int node = 0;
  Vec3 inertia = Vec3::Ones();
};

}  // namespace pbd
