// Reading an effect's constraints, by index.
#pragma once

#include "effects/effects.h"
#include "rows.h"

namespace pbd {

template <class E>
using BlockOf = RowBlock<Constraint<E>::rows, Constraint<E>::nodes>;

/// Positions (or velocities) of a constraint's nodes, one column a node.
template <std::size_t K>
Eigen::Matrix<double, 3, static_cast<int>(K)> positions_of(const std::array<int, K>& node, const Points& x) {
  Eigen::Matrix<double, 3, static_cast<int>(K)> local;
  for (std::size_t a = 0; a < K; ++a) local.col(static_cast<Eigen::Index>(a)) = x.col(node[a]);
  return local;
}

/// True if constraint i gives way: its A is positive definite.
template <class E>
bool compliant(const E& effect, std::size_t i) {
  return Constraint<E>::compliance(effect, i).diagonal().minCoeff() > 0;
}

}  // namespace pbd
