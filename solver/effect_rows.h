// Reading an effect's constraints, by index.
#pragma once

#include <Eigen/Dense>

#include "effects/effects.h"
#include "rows.h"

namespace pbd {

template <class E>
using BlockOf = RowBlock<Constraint<E>::rows, Constraint<E>::nodes>;

template <class E>
std::size_t constraint_count(const E& effect) {
  if constexpr (BodyEffect<E>)
    return effect.body.size();
  else
    return effect.node.size();
}

/// Columns of constraint i: its nodes, or two a body.
template <class E>
typename Constraint<E>::Nodes columns_of(const Scene& scene, const E& effect, std::size_t i) {
  if constexpr (BodyEffect<E>) {
    typename Constraint<E>::Nodes columns{};
    std::size_t next = 0;
    for (const int body : Constraint<E>::body(effect, i)) {
      columns[next++] = scene.bodies[static_cast<std::size_t>(body)].node;
      columns[next++] = scene.nodes() + body;
    }
    if constexpr (Constraint<E>::nodes > 2 * Constraint<E>::bodies) columns[next] = effect.node[i];
    return columns;
  } else {
    return Constraint<E>::node(effect, i);
  }
}

/// Positions (or velocities) of a constraint's nodes, one column a node.
template <std::size_t K>
Eigen::Matrix<double, 3, static_cast<int>(K)> positions_of(const std::array<int, K>& node, const Points& x) {
  Eigen::Matrix<double, 3, static_cast<int>(K)> local;
  for (std::size_t a = 0; a < K; ++a) local.col(static_cast<Eigen::Index>(a)) = x.col(node[a]);
  return local;
}

/// What constraint i with these columns is evaluated at.
template <class E>
typename Constraint<E>::Positions local(const E& effect, std::size_t i,
                                        const typename Constraint<E>::Nodes& columns,
                                        const Configuration& at) {
  if constexpr (BodyEffect<E>) {
    typename Constraint<E>::Positions own;
    std::size_t next = 0;
    for (const int body : Constraint<E>::body(effect, i))
      own.body[next++] = &at.pose[static_cast<std::size_t>(body)];
    if constexpr (Constraint<E>::nodes > 2 * Constraint<E>::bodies) own.node = at.x.col(columns.back());
    own.time = at.time;
    return own;
  } else {
    return positions_of(columns, at.x);
  }
}

/// J of constraint i at other positions than its value's.
template <class E, class Block>
void take_directions(const E& effect, const Configuration& at, std::size_t i, const Block& block,
                     typename Block::Jacobian& jacobian) {
  typename Block::Value value;
  const std::size_t entry = block.entry(i);
  Constraint<E>::evaluate(effect, entry, local(effect, entry, block.node[i], at), value, jacobian);
}

/// Inverse of a symmetric positive semidefinite N; its pseudo-inverse, and `singular` set, if it is not
/// definite.
Eigen::Matrix2d invert(const Eigen::Matrix2d& n, bool& singular);
Eigen::Matrix3d invert(const Eigen::Matrix3d& n, bool& singular);
Eigen::Matrix<double, 6, 6> invert(const Eigen::Matrix<double, 6, 6>& n, bool& singular);
inline Eigen::Matrix<double, 1, 1> invert(const Eigen::Matrix<double, 1, 1>& n, bool& singular) {
  singular = !(n(0, 0) > 0);
  return Eigen::Matrix<double, 1, 1>(singular ? 0.0 : 1 / n(0, 0));
}

/// Sets what stands for N_ii^-1 of constraint i; true if N_ii is singular.
template <class Block>
bool invert_diagonal(Block& block, const std::vector<double>& inverse_mass, std::size_t i) {
  typename Block::Square n = block.compliance[i];
  for (int a = 0; a < Block::nodes; ++a) {
    const auto part = block.jacobian[i].template middleCols<3>(3 * a);
    n.noalias() += inverse_mass[static_cast<std::size_t>(block.node[i][static_cast<std::size_t>(a)])] *
                   (part * part.transpose());
  }
  bool singular = false;
  if (block.frictional()) {
    block.delassus[i] = n;
    block.inverse_diagonal[i] = Block::rows / n.trace() * Block::Square::Identity();
  } else {
    block.inverse_diagonal[i] = invert(n, singular);
  }
  return singular;
}

/// True if the effect's forces have bounds.
template <class E>
bool has_bounds(const E& effect) {
  if constexpr (requires { effect.bounds; }) return !effect.bounds.empty();
  return false;
}

/// True if constraint i gives way: its A is positive definite.
template <class E>
bool compliant(const E& effect, std::size_t i) {
  return Constraint<E>::compliance(effect, i).diagonal().minCoeff() > 0;
}

}  // namespace pbd
