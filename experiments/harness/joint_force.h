// Forces of joints.
#pragma once

#include "scenes/named.h"
#include "step/step.h"

namespace pbdcheck {

/// Force (N) and torque (N m) about the joint's point of its second body that the joint exerts on that body,
/// in the world's axes.
struct Wrench {
  pbd::Vec3 force = pbd::Vec3::Zero();
  pbd::Vec3 torque = pbd::Vec3::Zero();
};

/// Of the state where the last step of `workspace` ended: the step's forces along the directions there.
Wrench joint_force(const NamedJoint& joint, const pbd::Scene& scene, const pbd::State& end,
                   const pbd::Workspace& workspace);

}  // namespace pbdcheck
