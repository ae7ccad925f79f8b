#include "semismooth.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "relaxation.h"

namespace pbd {
namespace {

/// own dp + by_step J dv = right, constraint i's row of the linear system.
template <class Block>
struct LinearLaw {
  typename Block::Square own, by_step;
  typename Block::Value right;
};

template <class Block>
LinearLaw<Block> linear_law(const Block& block, std::size_t i, const Points& v, double shift) {
  using Square = typename Block::Square;
  LinearLaw<Block> law{Square::Identity(), Square::Zero(), Block::Value::Zero()};
  const double weight = block.inverse_diagonal[i].trace() / Block::rows;  // about w
  if (!(weight > 0)) return law;                                          // nothing that it could move
  const typename Block::Value r = block.residual(v, i, block.impulse[i]);
  const typename Block::Value step = -block.inverse_diagonal[i] * r;
  const auto found = block.derivatives(block.projected_law(i), i, block.impulse[i], step);
  law.by_step = found.by_change;
  Square compliance = block.compliance[i];
  compliance.diagonal().array() += shift / weight;
  law.own = law.by_step * compliance;
  law.right = -r;
  if (block.bounded()) {
    law.own += (Square::Identity() - found.by_p) / weight;
    law.right = block.allowed(i, block.impulse[i], step) / weight;
  }
  return law;
}

bool has_local_contacts(const Rows& rows) {
  return std::any_of(rows.blocks.begin(), rows.blocks.end(),
                     [](const AnyBlock& block) { return std::holds_alternative<LocalContacts>(block); });
}

}  // namespace

double natural_residual(const Rows& rows, const Points& v) {
  double squared = 0;
  each_constraint(rows, [&](const auto& block, std::size_t i, Eigen::Index) {
    const auto r = block.residual(v, i, block.impulse[i]);
    squared +=
        block.squared_residual(i, r, block.allowed(i, block.impulse[i], -block.inverse_diagonal[i] * r));
  });
  return std::sqrt(squared);
}

void SemismoothNewton::assemble(const Rows& rows, const Points& v) {
  system_.begin(rows);
  const auto impulses = static_cast<int>(row_count(rows));
  keeps_impulses_ = impulses <= system_.size || has_local_contacts(rows);
  const int unknowns = system_.size + (keeps_impulses_ ? impulses : 0);
  right_.setZero(unknowns);
  each_constraint(rows, [&]<class Block>(const Block& block, std::size_t i, Eigen::Index first) {
    const auto [own, by_step, right] = linear_law(block, i, v, shift_);
    if (!keeps_impulses_) {
      const typename Block::Square inverse = own.inverse();
      system_.add(block, i, inverse * by_step);
      system_.push(block, i, inverse * right, right_);
      return;
    }
    const int row = system_.size + static_cast<int>(first);
    right_.segment<Block::rows>(row) = right;
    auto& entries = system_.entries;
    for (int k = 0; k < Block::rows; ++k)
      for (int l = 0; l < Block::rows; ++l) entries.emplace_back(row + k, row + l, own(k, l));
    if constexpr (is_local<Block>)
      for (const auto& [contact, w] : block.column[i]) {  // J dv = W dp
        const typename Block::Square coupled = by_step * w.transpose();
        const int other = row + Block::rows * (contact - static_cast<int>(i));
        for (int k = 0; k < Block::rows; ++k)
          for (int l = 0; l < Block::rows; ++l) entries.emplace_back(row + k, other + l, coupled(k, l));
      }
    const typename Block::Jacobian across = by_step * block.jacobian[i];
    system_.each_node(block, i, [&](int column, int a) {
      for (int k = 0; k < Block::rows; ++k)
        for (int axis = 0; axis < 3; ++axis) {
          entries.emplace_back(row + k, column + axis, across(k, 3 * a + axis));
          entries.emplace_back(column + axis, row + k, -block.jacobian[i](k, 3 * a + axis));
        }
    });
  });
  matrix_.resize(unknowns, unknowns);
  matrix_.setFromTriplets(system_.entries.begin(), system_.entries.end());
}

/// The step of the impulses, one entry a row.
void SemismoothNewton::find_step(const Rows& rows, const Points& v) {
  solution_ = factor_->solve(right_);
  step_.resize(row_count(rows));
  if (keeps_impulses_) {
    step_ = solution_.tail(step_.size());
    return;
  }
  each_constraint(rows, [&]<class Block>(const Block& block, std::size_t i, Eigen::Index first) {
    const auto [own, by_step, right] = linear_law(block, i, v, shift_);
    step_.segment<Block::rows>(first) =
        own.inverse() * (right - by_step * system_.along(block, i, solution_));
  });
}

/// Solves the linear system and takes the longest step that ends below that residual; false, and nothing
/// changed, where none does.
bool SemismoothNewton::descend(Rows& rows, Points& v, double below) {
  assemble(rows, v);
  factor_->compute(matrix_);
  if (factor_->info() != Eigen::Success) return false;
  find_step(rows, v);
  for (double length = 1; length > 0.1; length /= 2) {
    each_constraint(rows, [&]<class Block>(Block& block, std::size_t i, Eigen::Index first) {
      const typename Block::Value target = block.impulse[i] + length * step_.segment<Block::rows>(first);
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
  keep_impulses_and_biases(rows, kept_);
  start_ = v;
  constexpr double change = 100;
  const bool augments = AugmentedLagrangian::applies(rows);
  const int attempts = augments ? 2 : 3;
  for (int k = 0; k < attempts; ++k) {
    if (descend(rows, v, enough * residual)) {
      shift_ = std::max(least_shift, shift_ / change);
      return residual;
    }
    shift_ = std::min(1e-2, shift_ * change);
  }
  if (augments) {
    for (int call = 0; call <= idle_; ++call) {
      further_sweeps_ += augmented_.improve(rows, v);
      if (natural_residual(rows, v) < enough * residual) {
        shift_ = least_shift;
        return residual;
      }
    }
    restore_impulses_and_biases(kept_, rows);
    v = start_;
  }
  const int instead = 10 * (1 + idle_);
  for (int sweep = 0; sweep < instead; ++sweep) GaussSeidel{}.sweep(rows, v, nullptr);
  further_sweeps_ += instead;
  return residual;
}

}  // namespace pbd
