#include "semismooth.h"

#include <cmath>

#include "relaxation.h"

namespace pbd {
namespace {

/// f(block, i, number of its first row) for every constraint.
template <class AnyRows, class F>
void each_constraint(AnyRows& rows, F&& f) {
  int row = 0;
  for_each_block(rows.blocks, [&](auto& block) {
    for (std::size_t i = 0; i < block.size(); ++i, row += block.rows) f(block, i, row);
  });
}

/// P_p and P_step of constraint i.
template <class Block>
void derivative(const Block& block, std::size_t i, const typename Block::Value& step,
                typename Block::Square& by_p, typename Block::Square& by_step) {
  by_p.setZero();
  by_step.setIdentity();
  if (!block.bounded()) return;
  by_p.setIdentity();
  if constexpr (Block::rows == 1) {
    const double to = block.impulse[i][0] + step[0];
    if (to < block.bounds[i][0] || to > block.bounds[i][1]) by_p.setZero(), by_step.setZero();
  }
  if constexpr (Block::rows == 3) {
    const auto found = project_derivative(block.law, block.friction[i], block.impulse[i], step);
    by_p = found.by_p;
    by_step = found.by_step;
  }
}

}  // namespace

double natural_residual(const Rows& rows, const Points& v) {
  double squared = 0;
  each_constraint(rows, [&](const auto& block, std::size_t i, int) {
    const auto r = block.residual(v, i, block.impulse[i]);
    squared +=
        block.squared_residual(i, r, block.allowed(i, block.impulse[i], -block.inverse_diagonal[i] * r));
  });
  return std::sqrt(squared);
}

void SemismoothNewton::assemble(const Rows& rows, const Points& v) {
  entries_.clear();
  column_.assign(rows.inverse_mass.size(), -1);
  int unknowns = 0;
  for (std::size_t node = 0; node < column_.size(); ++node)
    if (rows.inverse_mass[node] > 0) {
      column_[node] = unknowns;
      for (int axis = 0; axis < 3; ++axis, ++unknowns)
        entries_.emplace_back(unknowns, unknowns, 1 / rows.inverse_mass[node]);
    }
  const int velocities = unknowns;
  unknowns += static_cast<int>(row_count(rows));
  right_.setZero(unknowns);
  each_constraint(rows, [&]<class Block>(const Block& block, std::size_t i, int first) {
    const int row = velocities + first;
    const typename Block::Value r = block.residual(v, i, block.impulse[i]);
    const typename Block::Value step = -block.inverse_diagonal[i] * r;
    typename Block::Square by_p, by_step;
    derivative(block, i, step, by_p, by_step);
    const double weight = block.inverse_diagonal[i].trace() / Block::rows;  // about w
    typename Block::Square compliance = block.compliance[i];
    compliance.diagonal().array() += weight > 0 ? shift_ / weight : 1.0;
    typename Block::Square own = by_step * compliance;
    if (block.bounded()) own += (Block::Square::Identity() - by_p) / weight;
    const typename Block::Jacobian across = by_step * block.jacobian[i];
    right_.segment<Block::rows>(row) =
        block.bounded() ? typename Block::Value(block.allowed(i, block.impulse[i], step) / weight)
                        : typename Block::Value(-r);
    if constexpr (is_local<Block>)
      for (const auto& [contact, w] : block.column[i]) {  // J dv = W dp
        const typename Block::Square coupled = by_step * w.transpose();
        const int other = row + Block::rows * (contact - static_cast<int>(i));
        for (int k = 0; k < Block::rows; ++k)
          for (int l = 0; l < Block::rows; ++l) entries_.emplace_back(row + k, other + l, coupled(k, l));
      }
    for (int k = 0; k < Block::rows; ++k) {
      for (int l = 0; l < Block::rows; ++l) entries_.emplace_back(row + k, row + l, own(k, l));
      for (int a = 0; a < Block::nodes; ++a) {
        const int column = column_[static_cast<std::size_t>(block.node[i][static_cast<std::size_t>(a)])];
        for (int axis = 0; column >= 0 && axis < 3; ++axis) {
          entries_.emplace_back(row + k, column + axis, across(k, 3 * a + axis));
          entries_.emplace_back(column + axis, row + k, -block.jacobian[i](k, 3 * a + axis));
        }
      }
    }
  });
  matrix_.resize(unknowns, unknowns);
  matrix_.setFromTriplets(entries_.begin(), entries_.end());
}

/// Solves the linear system and takes the longest step that ends below that residual; false, and nothing
/// changed, where none does.
bool SemismoothNewton::descend(Rows& rows, Points& v, double below) {
  assemble(rows, v);
  factor_->compute(matrix_);
  if (factor_->info() != Eigen::Success) return false;
  solution_ = factor_->solve(right_);
  const int velocities = static_cast<int>(solution_.size() - row_count(rows));
  keep_impulses_and_biases(rows, kept_);
  start_ = v;
  for (double length = 1; length > 0.1; length /= 2) {
    each_constraint(rows, [&]<class Block>(Block& block, std::size_t i, int first) {
      const typename Block::Value target =
          block.impulse[i] + length * solution_.segment<Block::rows>(velocities + first);
      const typename Block::Value change = block.cut(i, target) - block.impulse[i];
      block.impulse[i] += change;
      block.apply(rows.inverse_mass, i, change, v);
    });
    if (natural_residual(rows, v) < below) return true;
    restore_impulses_and_biases(kept_, rows);
    v = start_;
  }
  return false;
}

double SemismoothNewton::iterate(Rows& rows, Points& v) {
  const double residual = natural_residual(rows, v);
  constexpr double enough = 0.9;
  constexpr int patience = 10;
  idle_ = residual < enough * lowest_ ? 0 : idle_ + 1;
  lowest_ = std::min(lowest_, residual);
  if (!(residual > 0) || idle_ > patience) return 0;
  constexpr int attempts = 3, instead = 10;
  constexpr double change = 100;
  for (int k = 0; k < attempts; ++k) {
    if (descend(rows, v, enough * residual)) {
      shift_ = std::max(least_shift, shift_ / change);
      return residual;
    }
    shift_ = std::min(1e-2, shift_ * change);
  }
  for (int sweep = 0; sweep < instead; ++sweep) GaussSeidel{}.sweep(rows, v, nullptr);
  return residual;
}

}  // namespace pbd
