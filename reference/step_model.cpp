#include <cmath>

#include "step_equations.h"

namespace pbd::reference {
namespace {

/// As the judges know it: without contact, damping and bounds of forces.
Scene undamped(const Scene& scene) {
  Scene plain = scene;
  for (Effect& effect : plain.effects) {
    if (std::holds_alternative<Contact>(effect)) effect = ExternalForce{};
    std::visit(
        []<class E>(E& own) {
          if constexpr (requires { own.damping; }) own.damping = {};
          if constexpr (requires { own.bounds; }) own.bounds.clear();
        },
        effect);
  }
  return plain;
}

/// What a scene says of the rows of one effect.
void describe(const Scene& scene, int effect, int constraint, StepModel& model) {
  const Effect& stated = scene.effects[static_cast<std::size_t>(effect)];
  model.damped.push_back(damped(stated));
  model.goes_on.push_back(std::holds_alternative<AngleJoint>(stated));
  model.angle.push_back(model.goes_on.back() || std::holds_alternative<Bending>(stated));
  model.own_frame.push_back(damped(stated) && (std::holds_alternative<PointJoint>(stated) ||
                                               std::holds_alternative<Attachment>(stated)));
  std::array<double, 2> bounds{-infinity, infinity};
  std::string_view name;
  std::visit(
      [&]<class E>(const E& own) {
        name = own.name;
        if constexpr (requires { own.bounds; })
          if (!own.bounds.empty()) bounds = own.bounds[static_cast<std::size_t>(constraint)];
      },
      stated);
  model.bounds.push_back(bounds);
  model.name.push_back(std::string(name) + " " + std::to_string(constraint));
}

/// The pair of normals that multipliers of two rows are told of (StepClaim).
void take_told_normals(RigidModel& model) {
  for (Joint& joint : model.joints)
    if (joint.kind == JointKind::axis || joint.kind == JointKind::line) {
      joint.normal[0] = joint.axis[0].unitOrthogonal();
      joint.normal[1] = joint.axis[0].cross(joint.normal[0]);
    }
}

/// |v1 - v0|_M + |v_free - v0|_M by the states and given forces alone, sqrt(J); of implicit_euler.
double scale_of(const StepClaim& claim, const RigidModel& model) {
  double changed = 0, freely = 0;
  for (std::size_t i = 0; i < model.nodes.first.size(); ++i)
    if (const int u = model.nodes.first[i]; u >= 0) {
      const auto node = static_cast<Eigen::Index>(i);
      changed += model.nodes.mass(u) * (claim.end.v.col(node) - claim.start.v.col(node)).squaredNorm();
      freely += (claim.h * model.nodes.force.segment<3>(u)).squaredNorm() / model.nodes.mass(u);
    }
  for (std::size_t b = 0; b < model.rotors.size(); ++b) {
    const Rotor& rotor = model.rotors[b];
    if (rotor.unknown < 0) continue;
    const auto body = static_cast<Eigen::Index>(b);
    const Vec3 before = claim.start.spin.col(body), after = claim.end.spin.col(body);
    Vec3 torque = claim.start.orientation[b].conjugate() * rotor.torque;
    if (model.gyroscopic == GyroscopicTorque::at_start)
      torque -= before.cross(rotor.inertia.cwiseProduct(before));
    changed += rotor.inertia.dot((after - before).cwiseAbs2());
    freely += (claim.h * torque).cwiseAbs2().cwiseQuotient(rotor.inertia).sum();
  }
  return std::sqrt(changed) + std::sqrt(freely);
}

}  // namespace

StepModel make_step_model(const Scene& scene) {
  StepModel model{.rigid = make_rigid_model(undamped(scene))};
  take_told_normals(model.rigid);
  for (Element& element : model.rigid.nodes.elements)
    element.turns = damped(scene.effects[static_cast<std::size_t>(element.effect)]);
  std::vector<std::array<int, 2>> constraint(static_cast<std::size_t>(model.rigid.rows()));
  for (std::size_t i = 0; i < model.rigid.element_row.size(); ++i) {
    const Element& e = model.rigid.nodes.elements[i];
    for (int k = 0; k < e.rows; ++k) constraint[model.rigid.element_row[i] + k] = {e.effect, e.entry};
  }
  int last = -1, entry = 0;
  for (const Joint& joint : model.rigid.joints) {
    entry = joint.effect == last ? entry + 1 : 0;
    last = joint.effect;
    for (int k = 0; k < joint.rows; ++k) constraint[joint.row + k] = {joint.effect, entry};
  }
  for (const auto& [effect, number] : constraint) describe(scene, effect, number, model);
  return model;
}

bool is_euler_step(const StepClaim& claim) {
  return explicit_forces(claim) || (claim.integrator == "implicit_euler" && claim.direction_blend == 1);
}

bool explicit_forces(const StepClaim& claim) {
  return claim.integrator == "symplectic_euler";
}

double level_of(const StepClaim& claim, const StepModel& model) {
  double speed = 0, mass = 0, inertia = 0, size = claim.end.x.cwiseAbs().maxCoeff();
  const auto& nodes = model.rigid.nodes;
  for (std::size_t i = 0; i < nodes.first.size(); ++i)
    if (const int u = nodes.first[i]; u >= 0) {
      const auto node = static_cast<Eigen::Index>(i);
      speed += nodes.mass(u) * (claim.start.v.col(node).squaredNorm() + claim.end.v.col(node).squaredNorm());
      mass += nodes.mass(u);
    }
  for (std::size_t b = 0; b < model.rigid.rotors.size(); ++b) {
    const auto body = static_cast<Eigen::Index>(b);
    const Rotor& rotor = model.rigid.rotors[b];
    if (rotor.unknown < 0) continue;
    inertia += rotor.inertia.sum();
    for (const State* state : {&claim.start, &claim.end})
      speed += rotor.inertia.dot(state->spin.col(body).cwiseAbs2());
  }
  for (const Joint& joint : model.rigid.joints)
    size = std::max({size, joint.point[0].norm(), joint.point[1].norm()});
  double turn = 1;  // rad, of a rotation as it is stated
  for (const Joint& joint : model.rigid.joints)
    if (joint.kind == JointKind::angle)
      turn = std::max(turn, std::abs(joint.rest + joint.rate * claim.end.time));
  const bool told = explicit_forces(claim) || !is_euler_step(claim);
  return claim.tolerance * (told ? claim.scale : scale_of(claim, model.rigid)) +
         step_rounding * (std::sqrt(speed) + (std::sqrt(mass) * size + turn * std::sqrt(inertia)) / claim.h);
}

}  // namespace pbd::reference
