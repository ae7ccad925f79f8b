#include "linear/augmented_lagrangian.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "linear/natural_residual.h"
#include "rows/dense.h"
#include "rows/laws.h"

namespace pbd {
namespace {

constexpr int rounds = 8;
constexpr double under_relaxation = 0.7;  // of changes of the slips, which may overshoot
constexpr int most_steps = 30;            // of Newton's method, in a round

/// sigma over N_ii: from a tenth by half decades, the last two 1e-4. Far from a solution a small one changes
/// the impulses so much that Newton's method ends late or not at all.
double share_of(int round) {
  return std::max(1e-4, std::pow(10, -1 - 0.5 * round));
}

template <class Block>
bool moves(const Block& block, std::size_t i) {
  return block.inverse_diagonal[i].trace() > 0;
}

/// sigma + Sigma; where there are bounds one number, so that projections remain Euclidean. (A soft contact's
/// tangential impulses then take more rounds.)
template <class Block>
typename Block::Square softness(const Block& block, std::size_t i, double share) {
  const auto identity = Block::Square::Identity();
  const double sigma = share * Block::rows / block.inverse_diagonal[i].trace();
  if (block.bounded()) return (sigma + block.compliance[i].trace()) * identity;
  return typename Block::Square(block.compliance[i]) + sigma * identity;
}

}  // namespace

bool AugmentedLagrangian::applies(const Rows& rows) {
  bool all = true;
  for_each_block(rows.blocks, [&]<class Block>(const Block& block) {
    all &= !is_local<Block> && (!block.frictional() || solves(block.law));
  });
  return all;
}

double AugmentedLagrangian::evaluate(const Rows& rows, const Points& v) {
  double value = 0;
  system_.begin(rows);
  gradient_.resize(system_.size);
  for (std::size_t node = 0; node < system_.column.size(); ++node)
    if (const int first = system_.column[node]; first >= 0) {
      const auto index = static_cast<Eigen::Index>(node);
      const Vec3 momentum = (v.col(index) - free_.col(index)) / rows.inverse_mass[node];
      gradient_.segment<3>(first) = momentum;
      value += rows.inverse_mass[node] * momentum.squaredNorm() / 2;
    }
  each_constraint(rows, [&]<class Block>(const Block& block, std::size_t i, Eigen::Index row) {
    using Value = typename Block::Value;
    if (!moves(block, i)) return;
    const typename Block::Square soft = softness(block, i, share_), stiff = inverse_of(soft);
    const Value anchor = anchor_.segment<Block::rows>(row);
    const Value change = -stiff * (block.residual(v, i, anchor) + slip_.segment<Block::rows>(row));
    const Value p = anchor + allowed(block, Friction::cone, i, anchor, change);
    asked_.segment<Block::rows>(row) = p;
    value += p.dot(soft * p) / 2;
    if constexpr (Block::rows == 1)
      value += p.dot(soft * (anchor + change - p));  // else at right angles, or zero
    system_.add(block, i, allowed_derivative(block, Friction::cone, i, anchor, change).by_change * stiff);
    system_.push(block, i, -p, gradient_);
  });
  return value;
}

AugmentedLagrangian::Minimised AugmentedLagrangian::minimise(const Rows& rows, Points& v) {
  constexpr double enough = 1e-4, settled = 1e-16, rounding = 1e-14;
  constexpr int halvings = 20;
  double value = evaluate(rows, v), first = 0;
  for (int count = 1; count <= most_steps; ++count) {
    pbd::assemble(system_.size, system_.entries, matrix_);
    if (!analysed_) factor_.analyse(matrix_);
    analysed_ = true;
    if (!factor_.factorise(matrix_)) return {count, true};
    step_ = factor_.solve(-gradient_);
    const double slope = gradient_.dot(step_);
    first = std::max(first, -slope);
    if (!(-slope > settled * first)) return {count, true};
    const bool last = -slope <= rounding * std::abs(value);  // the value tells nothing of the next
    double next = 0, length = 1;
    bool found = false;
    for (int k = 0; k < halvings && !found; ++k, length /= 2) {
      tried_ = v;
      for (std::size_t node = 0; node < system_.column.size(); ++node)
        if (const int column = system_.column[node]; column >= 0)
          tried_.col(static_cast<Eigen::Index>(node)) += length * step_.segment<3>(column);
      next = evaluate(rows, tried_);
      found = last || next <= value + enough * length * slope;
    }
    if (!found) {
      evaluate(rows, v);  // what v asks for
      return {count, true};
    }
    v = tried_;
    value = next;
    if (last) return {count, true};
  }
  return {most_steps, false};
}

int AugmentedLagrangian::improve(Rows& rows, Points& v) {
  free_ = v;
  each_constraint(rows, [&](const auto& block, std::size_t i, Eigen::Index) {
    block.apply(rows.inverse_mass, i, -block.impulse[i], free_);
  });
  analysed_ = false;
  anchor_.setZero(row_count(rows));
  slip_ = asked_ = anchor_;
  int factorisations = 0;
  for (int round = 0; round < rounds; ++round) {
    each_constraint(rows, [&]<class Block>(const Block& block, std::size_t i, Eigen::Index row) {
      anchor_.segment<Block::rows>(row) = asked_.segment<Block::rows>(row) = block.impulse[i];
      if constexpr (Block::rows == 3)
        if (block.frictional() && block.law != Friction::cone && block.bounds[i].freedom == Freedom::lawful)
          slip_[row] +=
              (round == 0 ? 1 : under_relaxation) *
              (block.friction[i] * block.residual(v, i, block.impulse[i]).template tail<2>().norm() -
               slip_[row]);
    });
    share_ = share_of(round);
    const Minimised minimised = minimise(rows, v);
    factorisations += minimised.factorisations;
    // What a function asks for that is not minimised is no better, but for the softest one's.
    const bool stays = round > 0 && !minimised.ended;
    v = free_;
    each_constraint(rows, [&]<class Block>(Block& block, std::size_t i, Eigen::Index row) {
      if (!stays) block.impulse[i] = asked_.segment<Block::rows>(row);
      block.apply(rows.inverse_mass, i, block.impulse[i], v);
    });
    if (stays) break;
  }
  return factorisations;
}

Sweep AugmentedLagrangian::sweep(Rows& rows, Points& v, BlockSeconds) {
  const double residual = natural_residual(rows, v);
  if (residual > 0) further_sweeps_ += improve(rows, v);
  return {residual};
}

}  // namespace pbd
