#include "linear/gauss_seidel.h"

#include <cmath>

#include "rows/laws.h"

namespace pbd {

PBD_FLATTEN Sweep GaussSeidel::sweep(Rows& rows, Points& v, BlockSeconds seconds) {
  double squared = 0;
  visit_blocks(rows.blocks, seconds, [&]<class Block>(Block& block, std::size_t) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      const typename Block::Value r = block.residual(v, i, block.impulse[i]);
      typename Block::Value change = allowed(block, i, block.impulse[i], -block.inverse_diagonal[i] * r);
      squared += squared_residual(block, i, r, change);  // all that this change is for with friction
      if constexpr (Block::rows == 3)
        if (block.frictional()) change = solved_impulse(block, i, r) - block.impulse[i];
      block.impulse[i] += change;
      block.apply(rows.inverse_mass, i, change, v);
    }
  });
  return {std::sqrt(squared)};
}

}  // namespace pbd
