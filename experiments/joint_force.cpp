#include "joint_force.h"

#include <Eigen/Dense>

#include "effect_rows.h"
#include "placed.h"

namespace pbdcheck {
namespace {

using pbd::Vec3;

/// Force and torque about the centre of mass on the second body of a constraint. Its Jacobian has for a body
/// the columns dc/dx and dc/dphi R/r (bodies.h).
template <class E>
Wrench on_second_body(const pbd::Scene& scene, const E& effect, std::size_t i, const pbd::Configuration& at,
                      const std::vector<double>& multipliers) {
  if constexpr (pbd::BodyEffect<E>) {
    using Constraint = pbd::Constraint<E>;
    if constexpr (Constraint::bodies == 2) {
      typename Constraint::Value value;
      typename Constraint::Jacobian jacobian;
      const auto local = pbd::local(effect, i, pbd::columns_of(scene, effect, i), at);
      Constraint::evaluate(effect, i, local, value, jacobian);
      value = Constraint::Value::Map(multipliers.data() + i * static_cast<std::size_t>(Constraint::rows));
      const Eigen::Matrix<double, 12, 1> force = jacobian.transpose() * value;
      return {force.template segment<3>(6),
              local.body[1]->turning.transpose().inverse() * force.template tail<3>()};
    }
  }
  return {};
}

}  // namespace

Wrench joint_force(const NamedJoint& joint, const pbd::Scene& scene, const pbd::State& end,
                   const pbd::Workspace& workspace) {
  const Placed placed(scene, end);
  Wrench sum;
  for (const auto& part : joint.parts) {
    const auto multipliers = workspace.forces(part.effect);
    const Wrench own = std::visit(
        [&](const auto& effect) {
          return on_second_body(scene, effect, part.constraint, placed.at(), multipliers);
        },
        scene.effects[part.effect]);
    sum.force += own.force;
    sum.torque += own.torque;
  }
  const auto& orientation = end.orientation[static_cast<std::size_t>(joint.body)];
  sum.torque -= (orientation * joint.point).cross(sum.force);
  return sum;
}

}  // namespace pbdcheck
