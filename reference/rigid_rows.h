// Constraints of a scene with rigid bodies, differentiated at given frames.
//
// Every constraint, compliant or hard, has a multiplier: c + A gamma = 0. A joint is differentiated by jets,
// in one of two coordinates of each frame:
//   turns        (dx, d), R exp([d]x): the gradient by d is the torque in the body's axes. The torque changes
//                as another turn e follows d, exp(d) exp(e) = exp(d + e + d x e / 2 + ...), hence
//                d2c/de dd = c'' + [dc/dd]x / 2, which is not symmetric
//   quaternions  (x, q), four components each, as if they were independent
#pragma once

#include <functional>
#include <vector>

#include "rigid_model.h"

namespace pbd::reference {

/// [a]x, with [a]x b = a x b.
inline Eigen::Matrix3d cross_matrix(const Vec3& a) {
  return Eigen::Matrix3d{{0, -a.z(), a.y()}, {a.z(), 0, -a.x()}, {-a.y(), a.x(), 0}};
}

/// Where all frames are.
struct Placement {
  Points x;  // of nodes
  std::vector<Eigen::Quaterniond> orientation;
  double time = 0;  // s
};

enum class Coordinates { turns, quaternions };

/// One constraint: value c (R), Jacobian (R x V), second derivatives of each row (V x V), compliance A (R x
/// R).
struct Block {
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 14, 14>;
  /// The coordinates of a node or of a body (`body` is -1 for a node) stand at `offset`.
  struct Part {
    int node, body, offset;
  };

  int row = 0;
  bool hard = true;
  RowVector value;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 14> jacobian;
  std::array<Square, 6> second;
  RowMatrix compliance;
  std::vector<Part> parts;

  int rows() const { return static_cast<int>(value.size()); }
  /// What J^T gamma changes by, gamma being that of the block's rows.
  Square geometric(const RowVector& gamma, Coordinates coordinates) const;
};

/// All constraints: the nodes' elements, then the joints.
std::vector<Block> blocks_at(const RigidModel& model, const Placement& at, Coordinates coordinates);

/// The same in turns, one after the other, without second derivatives: c and the rows along which forces
/// act. Of corotational tetrahedra without damping these hold the rotation fixed.
void each_block(const RigidModel& model, const Placement& at, const std::function<void(const Block&)>& use);

/// The constraint values of all rows alone.
Vector values_at(const RigidModel& model, const Placement& at);

}  // namespace pbd::reference
