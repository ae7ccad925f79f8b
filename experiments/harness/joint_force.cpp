#include "harness/joint_force.h"

#include <Eigen/Dense>

#include "effects/sources.h"
#include "harness/placed.h"

namespace pbdcheck {
namespace {

using pbd::Vec3;

/// Force and torque about the centre of mass on the second body of a constraint. Its columns are for a body
/// dc/dx and dc/dphi R/r (rows/bodies.h).
Wrench on_second_body(const pbd::Scene& scene, const pbd::Effect& effect, std::size_t i, int body,
                      const pbd::Configuration& at, const std::vector<double>& multipliers) {
  const auto source = pbd::make_source(scene, effect, pbd::Friction::coulomb);
  const Eigen::VectorXd push = source->push(i, multipliers, at);
  constexpr Eigen::Index two_bodies = 12;
  if (!source->kind().of_bodies || push.size() != two_bodies) return {};
  return {push.segment<3>(6), at.pose[body].turn_per_arc.transpose().inverse() * push.segment<3>(9)};
}

}  // namespace

Wrench joint_force(const NamedJoint& joint, const pbd::Scene& scene, const pbd::State& end,
                   const pbd::Workspace& workspace) {
  const Placed placed(scene, end);
  Wrench sum;
  for (const auto& part : joint.parts) {
    const auto multipliers = workspace.forces(part.effect);
    const Wrench own = on_second_body(scene, scene.effects[part.effect], part.constraint, joint.body,
                                      placed.at(), multipliers);
    sum.force += own.force;
    sum.torque += own.torque;
  }
  const auto& orientation = end.orientation[static_cast<std::size_t>(joint.body)];
  sum.torque -= (orientation * joint.point).cross(sum.force);
  return sum;
}

}  // namespace pbdcheck
