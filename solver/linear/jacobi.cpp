#include "linear/jacobi.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rows/laws.h"

namespace pbd {

void Jacobi::begin(Rows& rows, const Points& v, bool fresh) {
  if (fresh) caution_ = 1;
  omega_ = caution_ * std::min(1.0, 2 / bound_.update(rows, v));
  least_omega_ = omega_ / 2;
  last_residual_ = lowest_residual_ = infinity;
}

Sweep Jacobi::sweep(Rows& rows, Points& v, BlockSeconds seconds) {
  next_.resizeLike(v);
  each_columns(rows.threads, v.cols(), [&](Eigen::Index first, Eigen::Index count) {
    next_.middleCols(first, count) = v.middleCols(first, count);
  });
  double squared = 0;
  visit_blocks(rows.blocks, seconds, [&]<class Block>(Block& block, std::size_t) {
    add_scattered(block, squared, [&](std::size_t i, double& sum) {
      const typename Block::Value r = block.residual(v, i, block.impulse[i]);
      const typename Block::Value change =
          allowed(block, i, block.impulse[i], -block.by_inverse_diagonal(i, r));
      sum += squared_residual(block, i, r, change);
      block.impulse[i] += omega_ * change;
      block.apply(rows.inverse_mass, i, omega_ * change, next_);
    });
  });
  v.swap(next_);
  const double residual = std::sqrt(squared);
  constexpr double rounding = 1e-9, slower = 0.9;
  if (residual > (1 - rounding) * last_residual_) omega_ = std::max(least_omega_, slower * omega_);
  constexpr double unstable = 10;
  const bool grown = residual > unstable * lowest_residual_;
  if (grown) caution_ /= 2, omega_ /= 2, least_omega_ /= 2;
  lowest_residual_ = grown ? residual : std::min(lowest_residual_, residual);
  last_residual_ = residual;
  return {residual};
}

}  // namespace pbd
