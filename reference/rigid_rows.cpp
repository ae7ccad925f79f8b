#include "rigid_rows.h"

#include "dense.h"
#include "joint_values.h"
#include "polar.h"

namespace pbd::reference {
namespace {

const Eigen::Quaterniond& orientation(const Joint& joint, std::size_t k, const Placement& at) {
  static const Eigen::Quaterniond upright = Eigen::Quaterniond::Identity();
  return joint.body[k] < 0 ? upright : at.orientation[joint.body[k]];
}

template <class T>
JointFrame<T> fixed_frame(const Joint& joint, std::size_t k, const Placement& at) {
  const Vec3 x = at.x.col(joint.node[k]);
  return {{T(x[0]), T(x[1]), T(x[2])}, constant<T>(orientation(joint, k, at))};
}

/// A frame whose coordinates are the jet's variables from 6 k (turns) or 7 k (quaternions) on.
template <Coordinates C, class T>
JointFrame<T> moving_frame(const Joint& joint, std::size_t k, const Placement& at) {
  constexpr int size = C == Coordinates::turns ? 6 : 7;
  const int first = size * static_cast<int>(k);
  JointFrame<T> frame = fixed_frame<T>(joint, k, at);
  for (int i = 0; i < 3; ++i) frame.x[i].gradient(first + i) = 1;
  if (joint.body[k] < 0) return frame;
  if constexpr (C == Coordinates::turns) {
    // exp(d/2) to second order: cos(|d|/2) = 1 - |d|^2/8, sin(|d|/2)/|d| = 1/2.
    Triple<T> d;
    for (int i = 0; i < 3; ++i) d[i] = T::variable(0, first + 3 + i);
    const T w = T(1) - dot(d, d) * 0.125;
    frame.q = product(frame.q, {w, {d[0] * 0.5, d[1] * 0.5, d[2] * 0.5}});
  } else {
    frame.q.w.gradient(first + 3) = 1;
    for (int i = 0; i < 3; ++i) frame.q.v[i].gradient(first + 4 + i) = 1;
  }
  return frame;
}

template <Coordinates C, int Order = 2>
Block joint_block(const Joint& joint, const Placement& at) {
  constexpr int size = C == Coordinates::turns ? 6 : 7;
  using T = Jet<2 * size, Order>;
  const auto c =
      joint_value<T>(joint, moving_frame<C, T>(joint, 0, at), moving_frame<C, T>(joint, 1, at), at.time);
  Block block;
  block.row = joint.row;
  block.hard = joint.compliance == 0;
  block.value.resize(joint.rows);
  block.jacobian.resize(joint.rows, 2 * size);
  block.compliance = joint.compliance * RowMatrix::Identity(joint.rows, joint.rows);
  for (int k = 0; k < joint.rows; ++k) {
    const T& row = c[k];
    block.value(k) = row.value;
    block.jacobian.row(k) = row.gradient;
    if constexpr (Order == 2) block.second[k] = row.hessian;
  }
  for (std::size_t k = 0; k < 2; ++k)
    block.parts.push_back({joint.node[k], joint.body[k], size * static_cast<int>(k)});
  return block;
}

/// All but the derivatives.
Block stated_block(const Element& e, int row, const Local& local) {
  Block block;
  block.row = row;
  block.hard = e.hard();
  block.value = local.value;
  block.compliance.setZero(e.rows, e.rows);
  if (!e.hard() && e.rows == 1)
    block.compliance(0, 0) = 1 / e.stiffness(0, 0);
  else if (!e.hard())
    block.compliance = inverse(e.stiffness);
  for (int a = 0; a < e.nodes; ++a) block.parts.push_back({e.node[a], -1, 3 * a});
  return block;
}

Block element_block(const Element& e, int row, const Points& x) {
  Local local;
  differentiate(e, x, local);
  // From the entries of F, which is linear in the positions.
  Eigen::MatrixXd by_x = Eigen::MatrixXd::Zero(e.variables(), 3 * e.nodes);
  for (int a = 0; a < e.nodes; ++a)
    for (int q = 0; q < e.columns; ++q)
      by_x.block<3, 3>(3 * q, 3 * a) = e.weight(a, q) * Eigen::Matrix3d::Identity();
  Block block = stated_block(e, row, local);
  block.jacobian = product(local.jacobian, by_x);
  for (int k = 0; k < e.rows; ++k) block.second[k] = congruence(local.hessian[k], by_x);
  return block;
}

/// Without second derivatives, its rows those along which forces act.
Block element_rows(const Element& e, int row, const Points& x) {
  Local local;
  differentiate_once(e, x, local);
  if (e.kind == Kind::corotational && !e.turns)
    local.jacobian = held_rotation(local_matrix(e, x), Strain6::Zero()).jacobian;
  Block block = stated_block(e, row, local);
  block.jacobian.setZero(e.rows, 3 * e.nodes);
  for (int a = 0; a < e.nodes; ++a)
    for (int q = 0; q < e.columns; ++q)
      block.jacobian.middleCols<3>(3 * a) += e.weight(a, q) * local.jacobian.middleCols<3>(3 * q);
  return block;
}

}  // namespace

Block::Square Block::geometric(const RowVector& gamma, Coordinates coordinates) const {
  Square sum = Square::Zero(jacobian.cols(), jacobian.cols());
  for (int k = 0; k < rows(); ++k) sum += gamma(k) * second[k];
  if (coordinates == Coordinates::turns)
    for (const auto& [node, body, offset] : parts) {
      if (body < 0) continue;
      const Vec3 torque = jacobian.middleCols<3>(offset + 3).transpose() * gamma;
      sum.block<3, 3>(offset + 3, offset + 3) += cross_matrix(torque) / 2;
    }
  return sum;
}

std::vector<Block> blocks_at(const RigidModel& model, const Placement& at, Coordinates coordinates) {
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < model.element_row.size(); ++i)
    blocks.push_back(element_block(model.nodes.elements[i], model.element_row[i], at.x));
  for (const Joint& joint : model.joints)
    blocks.push_back(coordinates == Coordinates::turns ? joint_block<Coordinates::turns>(joint, at)
                                                       : joint_block<Coordinates::quaternions>(joint, at));
  return blocks;
}

void each_block(const RigidModel& model, const Placement& at, const std::function<void(const Block&)>& use) {
  for (std::size_t i = 0; i < model.element_row.size(); ++i)
    use(element_rows(model.nodes.elements[i], model.element_row[i], at.x));
  for (const Joint& joint : model.joints) use(joint_block<Coordinates::turns, 1>(joint, at));
}

Vector values_at(const RigidModel& model, const Placement& at) {
  Vector c(model.rows());
  for (std::size_t i = 0; i < model.element_row.size(); ++i) {
    const Element& e = model.nodes.elements[i];
    c.segment(model.element_row[i], e.rows) = constraint_value(e, at.x);
  }
  for (const Joint& joint : model.joints) {
    const auto value = joint_value<double>(joint, fixed_frame<double>(joint, 0, at),
                                           fixed_frame<double>(joint, 1, at), at.time);
    for (int k = 0; k < joint.rows; ++k) c(joint.row + k) = value[k];
  }
  return c;
}

}  // namespace pbd::reference
