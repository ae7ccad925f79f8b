// A scene with rigid bodies as the judges see it: its nodes and their constraints (energies.h), its bodies'
// rotations and its joints, with all constraints' rows numbered in the scene's order.
#pragma once

#include "energies.h"

namespace pbd::reference {

enum class JointKind { point, axis, perpendicular, rotation, line, distance, angle, slide };

/// One joint of the frames a, b: of two bodies, or of a body and a node (an attachment).
struct Joint {
  JointKind kind = JointKind::point;
  int effect = 0;  // position in the scene
  int rows = 3, row = 0;
  std::array<int, 2> body{-1, -1};  // -1: a node
  std::array<int, 2> node{};        // centres of mass, or the node
  std::array<Vec3, 2> point{Vec3::Zero(), Vec3::Zero()}, axis{}, reference{};
  std::array<Vec3, 2> normal{};  // of a's axis, unit vectors in a's frame
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  double rest = 0, rate = 0;
  double compliance = 0;
};

/// A body's rotation.
struct Rotor {
  int node = 0;
  int unknown = -1;  // first of its three angular velocities among all unknowns; -1 of infinite inertia
  Vec3 inertia = Vec3::Ones();  // kg m^2
  Vec3 torque = Vec3::Zero();   // external, N m, in the world
  double radius = 1;            // of gyration (m), to compare rotations with displacements
};

enum class GyroscopicTorque { none, at_start, at_end };

struct RigidModel {
  Model nodes;
  std::vector<Rotor> rotors;
  std::vector<Joint> joints;
  std::vector<int> element_row;  // first row of each of the nodes' elements
  std::vector<bool> hard;        // of each row
  GyroscopicTorque gyroscopic = GyroscopicTorque::none;
  int unknowns = 0;  // the nodes' first, then three of each body of finite inertia
  Vector inertia;    // per unknown: mass (kg) or principal moment (kg m^2)
  Vector radius;     // per unknown: 1, or the body's radius of gyration (m)

  int rows() const { return static_cast<int>(hard.size()); }
};

/// Throws SetupError for a scene that `validate` refuses, that lists damping or where nothing can move.
RigidModel make_rigid_model(const Scene& scene);

/// An orientation turned for one second by the angular velocity `turn` (rad) in the body's frame.
Eigen::Quaterniond turned_by(const Eigen::Quaterniond& orientation, const Vec3& turn);

}  // namespace pbd::reference
