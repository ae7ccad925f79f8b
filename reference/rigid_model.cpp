#include "rigid_model.h"

#include <Eigen/Dense>
#include <cmath>

#include "error.h"
#include "judged_effects.h"

namespace pbd::reference {
namespace {

/// Two unit vectors at right angles to `axis` and each other: Gram-Schmidt from the world axis least along
/// it.
std::array<Vec3, 2> normals(const Vec3& axis) {
  Eigen::Index least = 0;
  axis.cwiseAbs().minCoeff(&least);
  const Vec3 first = (Vec3::Unit(least) - axis[least] * axis).normalized();
  return {first, axis.cross(first)};
}

template <class>
inline constexpr bool never = false;

template <class E>
constexpr JointKind joint_kind() {
  if constexpr (std::is_same_v<E, PointJoint> || std::is_same_v<E, Attachment>)
    return JointKind::point;
  else if constexpr (std::is_same_v<E, AxisJoint>)
    return JointKind::axis;
  else if constexpr (std::is_same_v<E, PerpendicularJoint>)
    return JointKind::perpendicular;
  else if constexpr (std::is_same_v<E, RotationJoint>)
    return JointKind::rotation;
  else if constexpr (std::is_same_v<E, LineJoint>)
    return JointKind::line;
  else if constexpr (std::is_same_v<E, BodyDistance>)
    return JointKind::distance;
  else if constexpr (std::is_same_v<E, AngleJoint>)
    return JointKind::angle;
  else if constexpr (std::is_same_v<E, SlideJoint>)
    return JointKind::slide;
  else
    static_assert(never<E>, "a joint without its kind: state its value in joint_values.h, or refuse it");
}

constexpr int rows_of(JointKind kind) {
  switch (kind) {
    case JointKind::point:
    case JointKind::rotation:
      return 3;
    case JointKind::axis:
    case JointKind::line:
      return 2;
    case JointKind::perpendicular:
    case JointKind::distance:
    case JointKind::angle:
    case JointKind::slide:
      return 1;
  }
  return 0;
}

struct ModelBuilder {
  const Scene& scene;
  RigidModel& model;
  int effect = 0;

  void operator()(const Gyroscopic& torque) {
    model.gyroscopic = torque.implicit ? GyroscopicTorque::at_end : GyroscopicTorque::at_start;
  }
  void operator()(const ExternalTorque& external) {
    for (std::size_t i = 0; i < external.body.size(); ++i)
      model.rotors[external.body[i]].torque += external.torque[i];
  }
  void operator()(const Attachment& attachment) {
    for (std::size_t i = 0; i < attachment.body.size(); ++i) {
      Joint joint = made<Attachment>({attachment.body[i], -1}, attachment.compliance[i]);
      joint.node[1] = attachment.node[i];
      joint.point[0] = attachment.point[i];
      model.joints.push_back(joint);
    }
  }
  /// Joints of two bodies.
  template <Among<BodyEffects> E>
  void operator()(const E& stated) {
    if constexpr (requires { stated.bounds; })
      if (!stated.bounds.empty())
        throw SetupError(stated.name, "limits or motors of limited force",
                         "equations: the judges know no bounds of forces");
    for (std::size_t i = 0; i < stated.body.size(); ++i) model.joints.push_back(joint_of(stated, i));
  }
  /// Stated by model.cpp.
  template <Among<NodeEffects> E>
  void operator()(const E&) {}
  /// Never reached: make_node_model has refused it.
  template <Among<RefusedEffects> E>
  void operator()(const E&) {}

  template <class E>
  Joint made(const std::array<int, 2>& body, double compliance) const {
    Joint joint;
    joint.kind = joint_kind<E>();
    joint.rows = rows_of(joint.kind);
    joint.effect = effect;
    joint.body = body;
    joint.compliance = compliance;
    for (std::size_t k = 0; k < 2; ++k)
      if (body[k] >= 0) joint.node[k] = model.rotors[body[k]].node;
    return joint;
  }

  template <class E>
  Joint joint_of(const E& stated, std::size_t i) const {
    Joint joint = made<E>(stated.body[i], stated.compliance[i]);
    if constexpr (requires { stated.point; }) joint.point = stated.point[i];
    if constexpr (requires { stated.reference; }) joint.reference = stated.reference[i];
    if constexpr (requires { stated.axis[i][0][0]; })
      joint.axis = stated.axis[i];
    else if constexpr (requires { stated.axis; })
      joint.axis[0] = stated.axis[i];
    if constexpr (requires { stated.axis; }) joint.normal = normals(joint.axis[0]);
    if constexpr (requires { stated.rate; }) joint.rate = stated.rate[i];
    if constexpr (requires { stated.rest_length; }) joint.rest = stated.rest_length[i];
    if constexpr (requires { stated.rest_angle; }) joint.rest = stated.rest_angle[i];
    if constexpr (requires { stated.rest_position; }) joint.rest = stated.rest_position[i];
    if constexpr (requires { stated.rest; }) joint.rotation = stated.rest[i];
    return joint;
  }
};

void add_rotors(const Scene& scene, RigidModel& model) {
  model.unknowns = model.nodes.unknowns;
  for (const auto& [node, inertia] : scene.bodies) {
    Rotor rotor;
    rotor.node = node;
    rotor.inertia = inertia;
    const double mass = scene.mass[node];
    if (inertia.allFinite()) {
      rotor.unknown = model.unknowns;
      model.unknowns += 3;
      if (std::isfinite(mass)) rotor.radius = std::sqrt(inertia.maxCoeff() / mass);
    }
    model.rotors.push_back(rotor);
  }
  if (model.unknowns == 0)
    throw SetupError("scene mass", "infinite masses and inertias only", "at least one finite mass");
  model.inertia.resize(model.unknowns);
  model.inertia.head(model.nodes.unknowns) = model.nodes.mass;
  model.radius.setOnes(model.unknowns);
  for (const Rotor& rotor : model.rotors)
    if (rotor.unknown >= 0) {
      model.inertia.segment<3>(rotor.unknown) = rotor.inertia;
      model.radius.segment<3>(rotor.unknown).setConstant(rotor.radius);
    }
}

/// Rows in the scene's order; no effect has both elements and joints.
void number_rows(RigidModel& model) {
  std::size_t element = 0, joint = 0;
  const auto& elements = model.nodes.elements;
  model.element_row.resize(elements.size());
  const auto number = [&](int& first, int rows, bool hard) {
    first = model.rows();
    model.hard.insert(model.hard.end(), rows, hard);
  };
  while (element < elements.size() || joint < model.joints.size())
    if (joint == model.joints.size() ||
        (element < elements.size() && elements[element].effect < model.joints[joint].effect)) {
      number(model.element_row[element], elements[element].rows, elements[element].hard());
      ++element;
    } else {
      Joint& next = model.joints[joint++];
      number(next.row, next.rows, next.compliance == 0);
    }
}

}  // namespace

RigidModel make_rigid_model(const Scene& scene) {
  RigidModel model;
  model.nodes = make_node_model(scene);
  add_rotors(scene, model);
  ModelBuilder builder{scene, model};
  for (const Effect& effect : scene.effects) {
    std::visit(builder, effect);
    ++builder.effect;
  }
  number_rows(model);
  return model;
}

Eigen::Quaterniond turned_by(const Eigen::Quaterniond& orientation, const Vec3& turn) {
  const double angle = turn.norm();
  if (angle == 0) return orientation;
  return (orientation * Eigen::Quaterniond(Eigen::AngleAxisd(angle, turn / angle))).normalized();
}

}  // namespace pbd::reference
