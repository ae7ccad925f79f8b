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
  bool changed = false;
  visit_blocks(rows.blocks, seconds, [&]<class Block>(Block& block, std::size_t first_row) {
    if (!block.bounded()) return;
    for (std::size_t i = 0; i < block.size(); ++i) {
      const typename Block::Value r = block.residual(v, i, block.impulse[i]);
      const typename Block::Value full = -block.inverse_diagonal[i] * r;
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
      changed |= free != free_[first_row + i];
      free_[first_row + i] = free;
      if (change.isZero(0)) continue;
      squared += missed;
      block.impulse[i] += change;
      block.apply(rows.inverse_mass, i, change, v);
    }
  });
  return changed;
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

PBD_FLATTEN Sweep ConjugateGradients::sweep(Rows& rows, Points& v, BlockSeconds seconds) {
  double moved = 0;  // squared residual of what the laws have moved
  const bool set_changed = find_free(rows, v, seconds, moved);
  push_.setZero(3, v.cols());
  double product = 0, kept_product = 0;  // of r with the new and the last D^-1 r
  double slope = 0;                      // of r along the old direction
  visit_blocks(rows.blocks, seconds, [&]<class Block>(Block& block, std::size_t first_row) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      const typename Block::Value r = block.residual(v, i, block.impulse[i]);
      typename Block::Value next = block.inverse_diagonal[i] * r;
      if (block.bounded() && free_[first_row + i] == Free::none) next.setZero();
      if (block.bounded() && free_[first_row + i] == Free::first) next.tail(Block::rows - 1).setZero();
      auto last = entries(last_, block, first_row, i);
      product += r.dot(next);
      kept_product += r.dot(last);
      slope += r.dot(entries(direction_, block, first_row, i));
      last = next;
      block.apply(rows.inverse_mass, i, -next, push_);
    }
  });
  const double beta =
      last_product_ > 0 && !set_changed ? std::max(0.0, (product - kept_product) / last_product_) : 0.0;
  square_ = product + beta * (beta * square_ - 2 * slope);
  slope = beta * slope - product;
  velocity_ = push_ + beta * velocity_;
  double curvature = squared_mass_norm(rows.inverse_mass, velocity_);
  visit_blocks(rows.blocks, seconds, [&]<class Block>(Block& block, std::size_t first_row) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      auto direction = entries(direction_, block, first_row, i);
      direction = beta * direction - entries(last_, block, first_row, i);
      curvature += direction.dot(block.compliance[i] * direction);
      if constexpr (is_local<Block>) curvature += direction.dot(velocity_.col(block.node[i][0]));
    }
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
    for (std::size_t i = 0; i < block.size(); ++i)
      block.impulse[i] += length * entries(direction_, block, first_row, i);
  });
  v += length * velocity_;
  visit_blocks(rows.blocks, seconds, [&]<class Block>(Block& block, std::size_t) {
    for (std::size_t i = 0; block.bounded() && i < block.size(); ++i) {
      const typename Block::Value back = cut(block, i, block.impulse[i]) - block.impulse[i];
      if (back.isZero(0)) continue;
      block.impulse[i] += back;
      block.apply(rows.inverse_mass, i, back, v);
      last_product_ = 0;
    }
  });
  return {std::sqrt(moved + product)};
}

}  // namespace pbd
