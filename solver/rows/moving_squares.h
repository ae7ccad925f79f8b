// How much of a row's Jacobian moves.
#pragma once

#include <vector>

#include "rows/rows.h"

namespace pbd {

/// Of each row of J_i, the sum of squares over the columns that move: what is fixed rounds nothing, however
/// far from its centre a row acts on it.
template <class Block>
typename Block::Value moving_squares(const Block& block, std::size_t i,
                                     const std::vector<double>& inverse_mass) {
  typename Block::Value sum = Block::Value::Zero();
  for (int a = 0; a < Block::nodes; ++a)
    if (inverse_mass[block.node[i][a]] > 0)
      sum += block.jacobian[i].template middleCols<3>(3 * a).rowwise().squaredNorm();
  return sum;
}

}  // namespace pbd
