#include "linear/gauss_seidel.h"

#include <cmath>

#include "rows/laws.h"

namespace pbd {
namespace {

/// Solves constraint i alone, and adds its squared residual to `squared`. `bounded` may be false of a block
/// whose impulses have no bounds: it is quicker so.
template <bool bounded, class Block>
void solve_constraint(const std::vector<double>& inverse_mass, Block& block, std::size_t i, Points& v,
                      double& squared) {
  const typename Block::Value r = block.residual(v, i, block.impulse[i]);
  typename Block::Value change = -block.by_inverse_diagonal(i, r);
  if constexpr (bounded) {
    change = allowed(block, i, block.impulse[i], change);
    squared += squared_residual(block, i, r, change);  // all that this change is for with friction
    if constexpr (Block::rows == 3)
      if (block.frictional()) change = solved_impulse(block, i, r) - block.impulse[i];
  } else {
    squared -= r.dot(change);
  }
  block.impulse[i] += change;
  block.apply(inverse_mass, i, change, v);
}

}  // namespace

Sweep GaussSeidel::sweep(Rows& rows, Points& v, BlockSeconds seconds) {
  double squared = 0;
  visit_blocks(rows.blocks, seconds, [&]<class Block>(Block& block, std::size_t) PBD_FLATTEN {
    if (block.bounded())
      for (std::size_t i = 0; i < block.size(); ++i)
        solve_constraint<true>(rows.inverse_mass, block, i, v, squared);
    else
      for (std::size_t i = 0; i < block.size(); ++i)
        solve_constraint<false>(rows.inverse_mass, block, i, v, squared);
  });
  return {std::sqrt(squared)};
}

Sweep ColouredGaussSeidel::sweep(Rows& rows, Points& v, BlockSeconds seconds) {
  double squared = 0;
  visit_blocks(rows.blocks, seconds, [&]<class Block>(Block& block, std::size_t) {
    add_scattered(block, squared, [&](std::size_t i, double& sum) {
      solve_constraint<true>(rows.inverse_mass, block, i, v, sum);
    });
  });
  return {std::sqrt(squared)};
}

}  // namespace pbd
