#include "linear/semismooth_newton.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "linear/natural_residual.h"
#include "linear/smoothed_law.h"
#include "rows/dense.h"
#include "rows/laws.h"

namespace pbd {
namespace {

/// About w of constraint i, kg; 0 if it has nothing that it could move.
template <class Block>
double weight_of(const Block& block, std::size_t i) {
  return block.inverse_diagonal[i].trace() / Block::rows;
}

/// Of constraint i, whose rows miss r.
template <class Block>
LinearLaw<Block> linear_law(const Block& block, std::size_t i, const typename Block::Value& r, double shift) {
  using Square = typename Block::Square;
  LinearLaw<Block> law{Square::Identity(), Square::Zero(), Block::Value::Zero()};
  const double weight = weight_of(block, i);
  if (!(weight > 0)) return law;
  const typename Block::Value step = -block.by_inverse_diagonal(i, r);
  const auto found = allowed_derivative(block, projected_law(block, i), i, block.impulse[i], step);
  law.by_step = found.by_change;
  Square compliance = block.compliance[i];
  compliance.diagonal().array() += shift / weight;
  law.own = law.by_step * compliance;
  law.right = -r;
  if (block.bounded()) {
    law.own += (Square::Identity() - found.by_p) / weight;
    law.right = allowed(block, i, block.impulse[i], step) / weight;
  }
  return law;
}

/// True if the contact has a node that another one's impulses, which did `pushed`, move.
bool is_moved(const LocalContacts& block, std::size_t i, const LocalContacts::Pushed& pushed) {
  for (int a = 0; a < LocalContacts::nodes; ++a)
    if (!block.jacobian[i].middleCols<3>(3 * a).isZero(0) &&
        !pushed.middleRows<3>(3 * block.node[i][a]).isZero(0))
      return true;
  return false;
}

bool has_local_contacts(const Rows& rows) {
  return std::any_of(rows.blocks.begin(), rows.blocks.end(),
                     [](const AnyBlock& block) { return std::holds_alternative<LocalContacts>(block); });
}

template <class Block>
SmoothedLaw smoothed(const Block& block, std::size_t i, double smoothing, const Points& v) {
  return smoothed_law(block.law != Friction::cone, block.friction[i], block.delassus[i], smoothing,
                      block.impulse[i], block.residual(v, i, block.impulse[i]));
}

}  // namespace

/// What constraint i's rows miss, in a round with the term that holds impulses where it began.
template <class Block>
typename Block::Value SemismoothNewton::missed(const Block& block, std::size_t i, Eigen::Index first,
                                               const Points& v) const {
  typename Block::Value r = block.residual(v, i, block.impulse[i]);
  const double weight = weight_of(block, i);
  if (anchor_.size() > 0 && weight > 0)
    r += shift_ / weight * (block.impulse[i] - anchor_.segment<Block::rows>(first));
  return r;
}

template <class Block>
LinearLaw<Block> SemismoothNewton::law_of(const Block& block, std::size_t i, Eigen::Index first,
                                          const Points& v) const {
  if constexpr (Block::rows == 3)
    if (smoothing_ > 0 && is_smoothed(block, i)) {
      const auto [missed, by_p, by_r] = smoothed(block, i, smoothing_, v);
      typename Block::Square compliance = block.compliance[i];
      compliance.diagonal().array() += shift_ / weight_of(block, i);
      return {by_p + by_r * compliance, by_r, -missed};
    }
  return linear_law(block, i, missed(block, i, first, v), shift_);
}

double SemismoothNewton::residual(const Rows& rows, const Points& v) const {
  double squared = 0;
  each_constraint(rows, [&]<class Block>(const Block& block, std::size_t i, Eigen::Index first) {
    if constexpr (Block::rows == 3)
      if (smoothing_ > 0 && is_smoothed(block, i)) {
        squared += smoothed(block, i, smoothing_, v).missed.squaredNorm();
        return;
      }
    squared += squared_residual(block, i, missed(block, i, first, v));
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
    const auto [own, by_step, right] = law_of(block, i, first, v);
    if (!keeps_impulses_) {
      const typename Block::Square inverse = inverse_of(own);
      system_.add(block, i, inverse * by_step);
      system_.push(block, i, inverse * right, right_);
      return;
    }
    const int row = system_.size + static_cast<int>(first);
    right_.segment<Block::rows>(row) = right;
    auto& entries = system_.entries;
    for (int k = 0; k < Block::rows; ++k)
      for (int l = 0; l < Block::rows; ++l) entries.emplace_back(row + k, row + l, own(k, l));
    if constexpr (is_local<Block>) {
      block.push(i, rows.inverse_mass.size(), pushed_);
      for (std::size_t j = 0; j < block.size(); ++j) {  // J dv = W dp
        if (!is_moved(block, j, pushed_)) continue;
        const typename Block::Square coupled = by_step * block.coupling(j, pushed_).transpose();
        const int other = row + Block::rows * (static_cast<int>(j) - static_cast<int>(i));
        for (int k = 0; k < Block::rows; ++k)
          for (int l = 0; l < Block::rows; ++l) entries.emplace_back(row + k, other + l, coupled(k, l));
      }
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
  pbd::assemble(unknowns, system_.entries, matrix_);
}

/// The step of the impulses, one entry a row.
void SemismoothNewton::find_step(const Rows& rows, const Points& v) {
  solution_ = factor_.solve(right_);
  step_.resize(row_count(rows));
  if (keeps_impulses_) {
    step_ = solution_.tail(step_.size());
    return;
  }
  each_constraint(rows, [&]<class Block>(const Block& block, std::size_t i, Eigen::Index first) {
    const auto [own, by_step, right] = law_of(block, i, first, v);
    step_.segment<Block::rows>(first) =
        inverse_of(own) * (right - by_step * system_.along(block, i, solution_));
  });
}

/// Solves the linear system for the step; false where it has none.
bool SemismoothNewton::find_newton_step(const Rows& rows, const Points& v) {
  assemble(rows, v);
  if (right_.size() == 0) return false;  // nothing can move
  if (!factor_.factorise(matrix_)) return false;
  find_step(rows, v);
  return true;
}

/// Goes a part of the step, cut to what bounds and laws allow unless laws are smoothed.
void SemismoothNewton::take_step(Rows& rows, Points& v, double length) const {
  each_constraint(rows, [&]<class Block>(Block& block, std::size_t i, Eigen::Index first) {
    typename Block::Value change = length * step_.segment<Block::rows>(first);
    if (!(smoothing_ > 0)) change = cut(block, i, block.impulse[i] + change) - block.impulse[i];
    block.impulse[i] += change;
    block.apply(rows.inverse_mass, i, change, v);
  });
}

/// Solves the linear system and takes the longest step that ends below that residual; false, and nothing
/// changed, where none does.
bool SemismoothNewton::descend(Rows& rows, Points& v, double below) {
  constexpr double shortest = 0.1;  // step: other means gain more than shorter ones
  if (!find_newton_step(rows, v)) return false;
  for (double length = 1; length > shortest; length /= 2) {
    take_step(rows, v, length);
    if (residual(rows, v) < below) return true;
    restore_impulses_and_biases(kept_, rows);
    v = start_;
  }
  return false;
}

bool SemismoothNewton::improve(Rows& rows, Points& v, double residual, int attempts) {
  constexpr double change = 100;  // of the shift, from attempt to attempt
  keep_impulses_and_biases(rows, kept_);
  start_ = v;
  for (int k = 0; k < attempts; ++k) {
    if (descend(rows, v, enough_fall * residual)) {
      shift_ = std::max(least_shift, shift_ / change);
      return true;
    }
    shift_ = std::min(most_shift, shift_ * change);
  }
  return false;
}

SemismoothNewton::Round SemismoothNewton::advance(Rows& rows, Points& v) {
  constexpr int most_iterations = 10;
  constexpr double solved = 0.1;  // of the residual: the next round begins anew anyway
  constexpr double smaller = 3, larger = 10, least_part = 1e-7, most_part = 0.1;
  anchor_.resize(row_count(rows));
  each_constraint(rows, [&]<class Block>(const Block& block, std::size_t i, Eigen::Index first) {
    anchor_.segment<Block::rows>(first) = block.impulse[i];
  });
  shift_ = part_of_round_;
  double left = residual(rows, v);
  const double enough = solved * left;
  Round round{0, false};
  while (!round.solved && round.factorisations < most_iterations) {
    keep_impulses_and_biases(rows, kept_);
    start_ = v;
    ++round.factorisations;
    if (!descend(rows, v, left)) break;
    left = residual(rows, v);
    round.solved = left <= enough;
  }
  anchor_.resize(0);
  trust();
  part_of_round_ =
      std::clamp(round.solved ? part_of_round_ / smaller : part_of_round_ * larger, least_part, most_part);
  return round;
}

Sweep SemismoothNewton::sweep(Rows& rows, Points& v, BlockSeconds) {
  constexpr int attempts = 3;
  const double residual = natural_residual(rows, v);
  return {residual, !(residual > 0) || !improve(rows, v, residual, attempts)};
}

}  // namespace pbd
