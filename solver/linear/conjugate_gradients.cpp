#include "linear/conjugate_gradients.h"

#include <algorithm>
#include <cmath>

#include "rows/laws.h"
#include "rows/mass_norm.h"

namespace pbd {

void ConjugateGradients::begin(Rows& rows, const Points& v, bool) {
  direction_.assign(row_count(rows), 0.0);
  last_.assign(direction_.size(), 0.0);
  free_.assign(direction_.size(), Free::all);
  velocity_.setZero(3, v.cols());
  last_product_ = square_ = 0;
}

/// Takes impulses that their law would move along the surface of what it allows there, or to nothing, and
/// tells which parts of the impulses remain free. True if another set of them is.
bool ConjugateGradients::find_free(Rows& rows, Points& v, BlockSeconds seconds, double& squared) {
  Sums<2> sums{squared, 0};  // the squared residual, and how many change their set
  visit_blocks(rows.blocks, seconds, [&]<class Block>(Block& block, std::size_t first_row) {
    if (!block.bounded()) return;
    add_scattered(block, sums, [&](std::size_t i, Sums<2>& own) {
      const typename Block::Value r = block.residual(v, i, block.impulse[i]);
      const typename Block::Value full = -block.by_inverse_diagonal(i, r);
      typename Block::Value change = allowed(block, i, block.impulse[i], full);
      const double missed = squared_residual(block, i, r, change);
      Free free = Free::all;
      if (!block.frictional()) {
        if (change.isZero(0) && !keeps(block, i, block.impulse[i] + full)) free = Free::none;
        change.setZero();
      } else if (keeps(block, i, block.impulse[i] + full)) {
        change.setZero();  // it sticks
      } else {
        if constexpr (Block::rows == 3)
          change = (solved_impulse(block, i, r) - block.impulse[i]) / 2 + change / 2;
        const bool slides = block.impulse[i][0] + change[0] > 0 && block.law != Friction::cone;
        free = slides ? Free::first : Free::none;
      }
      own[1] += free != free_[first_row + i];
      free_[first_row + i] = free;
      if (change.isZero(0)) return;
      own[0] += missed;
      block.impulse[i] += change;
      block.apply(rows.inverse_mass, i, change, v);
    });
  });
  squared = sums[0];
  return sums[1] > 0;
}

/// Of a step along the direction until the first impulse is at a bound, of friction that of its normal part.
double ConjugateGradients::length_to_bounds(const Rows& rows) const {
  double length = infinity;
  std::size_t first_row = 0;
  for_each_block(rows.blocks, [&]<class Block>(const Block& block) {
    if constexpr (Block::rows == 1)
      for (std::size_t i = 0; block.bounded() && i < block.size(); ++i) {
        const double along = direction_[first_row + i];
        const double bound = along < 0 ? block.bounds[i].lower : block.bounds[i].upper;
        if (along != 0 && block.bounds[i].freedom == Freedom::lawful)
          length = std::min(length, std::max(0.0, (bound - block.impulse[i][0]) / along));
      }
    if constexpr (Block::rows == 3)
      for (std::size_t i = 0; block.frictional() && i < block.size(); ++i)
        if (const double along = direction_[first_row + 3 * i]; along < 0)
          length = std::min(length, std::max(0.0, -block.impulse[i][0] / along));
    first_row += block.size() * Block::rows;
  });
  return length;
}

Sweep ConjugateGradients::sweep(Rows& rows, Points& v, BlockSeconds seconds) {
  double moved = 0;  // squared residual of what the laws have moved
  const bool set_changed = find_free(rows, v, seconds, moved);
  push_.resizeLike(v);
  each_columns(rows.threads, v.cols(),
               [&](Eigen::Index first, Eigen::Index count) { push_.middleCols(first, count).setZero(); });
  Sums<3> sums{};  // r with the new and the last D^-1 r, and along the old direction
  visit_blocks(rows.blocks, seconds, [&]<class Block>(Block& block, std::size_t first_row) {
    add_scattered(block, sums, [&](std::size_t i, Sums<3>& own) {
      const typename Block::Value r = block.residual(v, i, block.impulse[i]);
      typename Block::Value next = block.by_inverse_diagonal(i, r);
      if (block.bounded() && free_[first_row + i] == Free::none) next.setZero();
      if (block.bounded() && free_[first_row + i] == Free::first) next.tail(Block::rows - 1).setZero();
      auto last = entries(last_, block, first_row, i);
      own[0] += r.dot(next);
      own[1] += r.dot(last);
      own[2] += r.dot(entries(direction_, block, first_row, i));
      last = next;
      block.apply(rows.inverse_mass, i, -next, push_);
    });
  });
  const double product = sums[0], kept_product = sums[1];
  double slope = sums[2];
  const double beta =
      last_product_ > 0 && !set_changed ? std::max(0.0, (product - kept_product) / last_product_) : 0.0;
  square_ = product + beta * (beta * square_ - 2 * slope);
  slope = beta * slope - product;
  each_columns(rows.threads, v.cols(), [&](Eigen::Index first, Eigen::Index count) {
    auto moving = velocity_.middleCols(first, count);
    moving = push_.middleCols(first, count) + beta * moving;
  });
  double curvature = squared_mass_norm(rows.inverse_mass, velocity_, rows.threads);
  visit_blocks(rows.blocks, seconds, [&]<class Block>(Block& block, std::size_t first_row) {
    add_each(block, curvature, [&](std::size_t i, double& own) {
      auto direction = entries(direction_, block, first_row, i);
      direction = beta * direction - entries(last_, block, first_row, i);
      own += direction.dot(block.compliance[i] * direction);
      if constexpr (is_local<Block>) own += direction.dot(block.jacobian[i] * block.gather(velocity_, i));
    });
  });
  last_product_ = product;
  constexpr double redundant = 1e-10;  // s changes next to no velocity: what rows contradict each other by
  if (!(curvature > redundant * square_)) {
    last_product_ = 0;
    if (beta > 0) return {std::sqrt(moved + product)};  // begin anew
    return {std::sqrt(moved), moved == 0};              // nothing left to gain along J
  }
  // Contacts that nearly contradict each other share their impulses out until one of them has none.
  constexpr double shared = 1e-5;
  const bool to_all = rows.contacts && curvature > shared * square_;
  const double length = std::min(-slope / curvature, to_all ? infinity : length_to_bounds(rows));
  visit_blocks(rows.blocks, seconds, [&]<class Block>(Block& block, std::size_t first_row) {
    each_own(block,
             [&](std::size_t i) { block.impulse[i] += length * entries(direction_, block, first_row, i); });
  });
  each_columns(rows.threads, v.cols(), [&](Eigen::Index first, Eigen::Index count) {
    v.middleCols(first, count) += length * velocity_.middleCols(first, count);
  });
  Sums<1> cut_back{};  // above 0 where anything was
  visit_blocks(rows.blocks, seconds, [&]<class Block>(Block& block, std::size_t) {
    if (!block.bounded()) return;
    add_scattered(block, cut_back, [&](std::size_t i, Sums<1>& own) {
      const typename Block::Value back = cut(block, i, block.impulse[i]) - block.impulse[i];
      if (back.isZero(0)) return;
      block.impulse[i] += back;
      block.apply(rows.inverse_mass, i, back, v);
      own[0] = 1;
    });
  });
  if (cut_back[0] > 0) last_product_ = 0;
  return {std::sqrt(moved + product)};
}

}  // namespace pbd
