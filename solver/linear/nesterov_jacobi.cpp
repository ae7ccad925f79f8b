#include "linear/nesterov_jacobi.h"

#include <cmath>

#include "rows/laws.h"
#include "rows/mass_norm.h"

namespace pbd {

void NesterovJacobi::begin(Rows& rows, const Points& v, bool fresh) {
  omega_ = 1 / bound_.update(rows, v);
  previous_v_ = v;
  const auto count = static_cast<std::size_t>(row_count(rows));
  if (fresh || previous_.size() != count) {  // contacts may have joined within the step
    fresh = true;
    restart();
    previous_.resize(count);
  }
  // The velocities of the previous impulses along the new directions; a fresh start has no previous impulses.
  std::size_t first_row = 0;
  for_each_block(rows.blocks, [&]<class Block>(const Block& block) {
    each_scattered(block, [&](std::size_t i) {
      auto previous = entries(previous_, block, first_row, i);
      if (fresh)
        previous = block.impulse[i];
      else
        block.apply(rows.inverse_mass, i, previous - block.impulse[i], previous_v_);
    });
    first_row += block.size() * Block::rows;
  });
}

/// Compares q^T N q / q^T D q of the change q of the impulses, that gave `v` from the extrapolated
/// velocities, with the bound 1/omega. `compliant` is q^T Sigma q.
bool NesterovJacobi::bound_holds(const Rows& rows, const Points& v, double residual_squared,
                                 double compliant) {
  const double stiff = squared_mass_distance(rows.inverse_mass, v, extrapolated_, compliant, rows.threads);
  constexpr double safety = 1.05;
  const double lengths = omega_ * omega_ * residual_squared;  // q^T D q
  if (!(stiff > safety * lengths / omega_) || !std::isfinite(stiff)) return true;
  bound_.met(safety * stiff / lengths);
  omega_ = lengths / (safety * stiff);
  return false;
}

Sweep NesterovJacobi::sweep(Rows& rows, Points& v, BlockSeconds seconds) {
  // v belongs to the impulses p; everything is linear, so v + beta (v - v_previous) belongs to the
  // extrapolated ones.
  extrapolated_.resizeLike(v);
  each_columns(rows.threads, v.cols(), [&](Eigen::Index first, Eigen::Index count) {
    auto now = v.middleCols(first, count), before = previous_v_.middleCols(first, count),
         further = extrapolated_.middleCols(first, count);
    further = now + beta_ * (now - before);
    before = now;
    now = further;
  });
  Sums<3> sums{};  // squared residual, what is compliant, the gradient along the step
  visit_blocks(rows.blocks, seconds, [&]<class Block>(Block& block, std::size_t first_row) {
    add_scattered(block, sums, [&](std::size_t i, Sums<3>& own) {
      auto previous = entries(previous_, block, first_row, i);
      const typename Block::Value start = block.impulse[i] + beta_ * (block.impulse[i] - previous);
      const typename Block::Value r = block.residual(extrapolated_, i, start);
      const typename Block::Value change =
          allowed(block, i, start, -omega_ * block.by_inverse_diagonal(i, r));
      own[0] += squared_residual(block, i, r, change) / (block.bounded() ? omega_ * omega_ : omega_);
      own[1] += change.dot(block.compliance[i] * change);
      if constexpr (is_local<Block>)  // its share of q^T W q, W symmetric
        own[1] += change.dot(2 * block.jacobian[i] * (block.gather(v, i) - block.gather(extrapolated_, i)) +
                             block.delassus[i] * change);
      previous = block.impulse[i];
      block.impulse[i] = start + change;
      own[2] += r.dot(block.impulse[i] - previous);
      block.apply(rows.inverse_mass, i, change, v);
    });
  });
  const double squared = sums[0], compliant = sums[1], gradient_along_step = sums[2];
  if (!bound_holds(rows, v, squared, compliant) || gradient_along_step > 0) {
    restart();
  } else {
    const double square = theta_ * theta_;
    const double next = (std::sqrt(square * square + 4 * square) - square) / 2;
    beta_ = theta_ * (1 - theta_) / (square + next);
    theta_ = next;
  }
  return {std::sqrt(squared)};
}

}  // namespace pbd
