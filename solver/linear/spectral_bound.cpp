#include "linear/spectral_bound.h"

#include <cmath>

#include "linear/sweeps.h"

namespace pbd {

double SpectralBound::power_step(const Rows& rows) {
  velocity_.setZero();
  std::size_t first_row = 0;
  for_each_block(rows.blocks, [&]<class Block>(const Block& block) {
    each_scattered(block, [&](std::size_t i) {
      block.apply(rows.inverse_mass, i, entries(vector_, block, first_row, i), velocity_);
    });
    first_row += block.size() * Block::rows;
  });
  // Rayleigh quotient of D^-1 N in the metric of N: (g^T D^-1 g)/(p^T g) with g = N p.
  Sums<2> quotient{};  // above and below its line
  first_row = 0;
  for_each_block(rows.blocks, [&]<class Block>(const Block& block) {
    add_each(block, quotient, [&](std::size_t i, Sums<2>& own) {
      auto p = entries(vector_, block, first_row, i);
      const typename Block::Value g = block.compliance[i] * p + block.rate(velocity_, i);
      const typename Block::Value next = block.by_inverse_diagonal(i, g);
      own[0] += g.dot(next);
      own[1] += p.dot(g);
      p = next;
    });
    first_row += block.size() * Block::rows;
  });
  const double estimate = quotient[1] > 0 ? quotient[0] / quotient[1] : 0.0;
  if (estimate > 0)
    for (double& entry : vector_) entry /= estimate;
  ++sweeps_;
  return estimate;
}

double SpectralBound::update(const Rows& rows, const Points& like) {
  sweeps_ = 0;
  int most_steps = 1;
  if (vector_.empty() || generation_ != rows.generation) {
    constexpr int from_nothing = 60;  // steps, unless the quotient settles to 1e-3 before
    generation_ = rows.generation;
    least_ = 1;
    most_steps = from_nothing;
    velocity_ = like;
    std::vector<int> constraints(rows.inverse_mass.size(), 0);
    std::size_t row = 0;
    vector_.resize(row_count(rows));
    for (double& entry : vector_) entry = 1 + 0.5 * irregular(row++);
    for_each_block(rows.blocks, [&](const auto& block) {
      for (const auto& nodes : block.node)
        for (const int node : nodes)
          if (rows.inverse_mass[node] > 0) ++constraints[node];
    });
    constraints_at_a_node_ =
        constraints.empty() ? 1 : *std::max_element(constraints.begin(), constraints.end());
    for_each_block(rows.blocks, [&]<class Block>(const Block&) {
      if (is_local<Block>) constraints_at_a_node_ = infinity;
    });
  }
  double estimate = 0;
  for (int k = 0; k < most_steps; ++k) {
    const double next = power_step(rows);
    constexpr double settles = 1e-3;  // well within the safety below
    const bool settled = std::abs(next - estimate) < settles * next;
    estimate = next;
    if (settled) break;
  }
  constexpr double safety = 1.05;
  return std::max(least_, std::min(constraints_at_a_node_, safety * estimate));
}

}  // namespace pbd
