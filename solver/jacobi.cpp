// Jacobi's relaxation, its acceleration, and the bound of the spectrum that both rest on.
#include <algorithm>
#include <cmath>
#include <limits>

#include "relaxation.h"
#include "sweeps.h"

namespace pbd {

double SpectralBound::power_step(const Rows& rows) {
  velocity_.setZero();
  std::size_t first_row = 0;
  for_each_block(rows.blocks, [&]<class Block>(const Block& block) {
    for (std::size_t i = 0; i < block.size(); ++i)
      block.apply(rows.inverse_mass, i, entries(vector_, block, first_row, i), velocity_);
    first_row += block.size() * Block::rows;
  });
  // Rayleigh quotient of D^-1 N in the metric of N: (g^T D^-1 g)/(p^T g) with g = N p.
  double upper = 0, lower = 0;
  first_row = 0;
  for_each_block(rows.blocks, [&]<class Block>(const Block& block) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      auto p = entries(vector_, block, first_row, i);
      const typename Block::Value g =
          block.compliance[i] * p + block.jacobian[i] * block.gather(velocity_, i);
      const typename Block::Value next = block.inverse_diagonal[i] * g;
      upper += g.dot(next);
      lower += p.dot(g);
      p = next;
    }
    first_row += block.size() * Block::rows;
  });
  const double estimate = lower > 0 ? upper / lower : 0.0;
  if (estimate > 0)
    for (double& entry : vector_) entry /= estimate;
  ++sweeps_;
  return estimate;
}

double SpectralBound::update(const Rows& rows, const Points& like) {
  sweeps_ = 0;
  int most_steps = 1;
  if (vector_.empty() || generation_ != rows.generation) {
    generation_ = rows.generation;
    most_steps = 60;
    velocity_ = like;
    std::vector<int> constraints(rows.inverse_mass.size(), 0);
    std::size_t row = 0;
    vector_.resize(static_cast<std::size_t>(row_count(rows)));
    for (double& entry : vector_) entry = 1 + 0.5 * irregular(row++);
    for_each_block(rows.blocks, [&](const auto& block) {
      for (const auto& nodes : block.node)
        for (const int node : nodes)
          if (rows.inverse_mass[static_cast<std::size_t>(node)] > 0)
            ++constraints[static_cast<std::size_t>(node)];
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
    const bool settled = std::abs(next - estimate) < 1e-3 * next;
    estimate = next;
    if (settled) break;
  }
  constexpr double safety = 1.05;
  return std::max(least_, std::min(constraints_at_a_node_, safety * estimate));
}

void Jacobi::begin(Rows& rows, const Points& v, bool fresh) {
  if (fresh) caution_ = 1;
  omega_ = caution_ * std::min(1.0, 2 / bound_.update(rows, v));
  least_omega_ = omega_ / 2;
  last_residual_ = lowest_residual_ = std::numeric_limits<double>::infinity();
}

PBD_FLATTEN double Jacobi::sweep(Rows& rows, Points& v, BlockSeconds seconds) {
  next_ = v;
  double squared = 0;
  visit_blocks(rows.blocks, seconds, [&]<class Block>(Block& block, std::size_t) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      const typename Block::Value r = block.residual(v, i, block.impulse[i]);
      const typename Block::Value change = block.allowed(i, block.impulse[i], -block.inverse_diagonal[i] * r);
      squared += block.squared_residual(i, r, change);
      block.impulse[i] += omega_ * change;
      block.apply(rows.inverse_mass, i, omega_ * change, next_);
    }
  });
  v.swap(next_);
  const double residual = std::sqrt(squared);
  constexpr double rounding = 1e-9;
  if (residual > (1 + rounding) * last_residual_) omega_ = std::max(least_omega_, 0.9 * omega_);
  constexpr double unstable = 10;
  const bool grown = residual > unstable * lowest_residual_;
  if (grown) caution_ /= 2, omega_ /= 2, least_omega_ /= 2;
  lowest_residual_ = grown ? residual : std::min(lowest_residual_, residual);
  last_residual_ = residual;
  return residual;
}

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
    for (std::size_t i = 0; i < block.size(); ++i) {
      auto previous = entries(previous_, block, first_row, i);
      if (fresh)
        previous = block.impulse[i];
      else
        block.apply(rows.inverse_mass, i, previous - block.impulse[i], previous_v_);
    }
    first_row += block.size() * Block::rows;
  });
}

/// Compares q^T N q / q^T D q of the change q of the impulses, that gave `v` from the extrapolated
/// velocities, with the bound 1/omega. `compliant` is q^T Sigma q.
bool NesterovJacobi::bound_holds(const Rows& rows, const Points& v, double residual_squared,
                                 double compliant) {
  double stiff = compliant;
  for (std::size_t node = 0; node < rows.inverse_mass.size(); ++node)
    if (rows.inverse_mass[node] > 0) {
      const auto column = static_cast<Eigen::Index>(node);
      stiff += (v.col(column) - extrapolated_.col(column)).squaredNorm() / rows.inverse_mass[node];
    }
  constexpr double safety = 1.05;
  const double lengths = omega_ * omega_ * residual_squared;  // q^T D q
  if (!(stiff > safety * lengths / omega_) || !std::isfinite(stiff)) return true;
  bound_.met(safety * stiff / lengths);
  omega_ = lengths / (safety * stiff);
  return false;
}

PBD_FLATTEN double NesterovJacobi::sweep(Rows& rows, Points& v, BlockSeconds seconds) {
  // v belongs to the impulses p; everything is linear, so v + beta (v - v_previous) belongs to the
  // extrapolated ones.
  extrapolated_ = v + beta_ * (v - previous_v_);
  previous_v_ = v;
  v = extrapolated_;
  double squared = 0, compliant = 0;
  double gradient_along_step = 0;
  visit_blocks(rows.blocks, seconds, [&]<class Block>(Block& block, std::size_t first_row) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      auto previous = entries(previous_, block, first_row, i);
      const typename Block::Value start = block.impulse[i] + beta_ * (block.impulse[i] - previous);
      const typename Block::Value r = block.residual(extrapolated_, i, start);
      const typename Block::Value change = block.allowed(i, start, -omega_ * (block.inverse_diagonal[i] * r));
      squared += block.squared_residual(i, r, change) / (block.bounded() ? omega_ * omega_ : omega_);
      compliant += change.dot(block.compliance[i] * change);
      if constexpr (is_local<Block>)  // its share of q^T W q, W symmetric
        compliant += change.dot(2 * (v.col(block.node[i][0]) - extrapolated_.col(block.node[i][0])) +
                                block.delassus[i] * change);
      previous = block.impulse[i];
      block.impulse[i] = start + change;
      gradient_along_step += r.dot(block.impulse[i] - previous);
      block.apply(rows.inverse_mass, i, change, v);
    }
  });
  if (!bound_holds(rows, v, squared, compliant) || gradient_along_step > 0) {
    restart();
  } else {
    const double square = theta_ * theta_;
    const double next = (std::sqrt(square * square + 4 * square) - square) / 2;
    beta_ = theta_ * (1 - theta_) / (square + next);
    theta_ = next;
  }
  return std::sqrt(squared);
}

}  // namespace pbd
