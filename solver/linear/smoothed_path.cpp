#include "linear/natural_residual.h"
#include "linear/semismooth_newton.h"
#include "linear/smoothed_law.h"

namespace pbd {

/// Takes the longest step, of those that are halved, that lowers the smoothed residual `left` enough; false
/// where none does.
bool SemismoothNewton::search(Rows& rows, Points& v, double& left, double& length) {
  constexpr double shortest = 1e-4, enough = 0.1;  // the second as a share of what the linear laws promise
  keep_impulses_and_biases(rows, kept_);
  start_ = v;
  const double before = left;
  for (length = 1; length > shortest; length /= 2) {
    take_step(rows, v, length);
    left = residual(rows, v);
    if (left <= (1 - enough * length) * before) return true;
    restore_impulses_and_biases(kept_, rows);
    v = start_;
  }
  return false;
}

SemismoothNewton::Round SemismoothNewton::follow_path(Rows& rows, Points& v, double residual_before) {
  constexpr int most_iterations = 60;
  constexpr double begin = 0.1;  // the smoothing, of the residual without impulses
  constexpr double near = 3;     // times the smoothing: laws that are missed by less may be smoothed less
  constexpr double after_whole = 0.2, after_part = 0.5;  // of a step: what is left of the smoothing
  constexpr double enough = 1e-3;  // of the residual: Newton's method goes on from there
  Round round{0, false};
  bool any = false;
  each_constraint(rows, [&]<class Block>(const Block& block, std::size_t i, Eigen::Index) {
    if constexpr (Block::rows == 3) any |= is_smoothed(block, i);
  });
  if (!any) return round;
  keep_impulses_and_biases(rows, path_kept_);
  path_start_ = v;
  each_constraint(rows, [&]<class Block>(Block& block, std::size_t i, Eigen::Index) {
    if (!block.bounded()) return;
    const typename Block::Value change = -block.impulse[i];
    block.impulse[i].setZero();
    block.apply(rows.inverse_mass, i, change, v);
  });
  double natural = natural_residual(rows, v);
  smoothing_ = begin * natural;
  trust();
  double left = residual(rows, v);
  while (smoothing_ > 0 && !(natural <= enough * residual_before) && round.factorisations < most_iterations &&
         find_newton_step(rows, v)) {
    ++round.factorisations;
    double length = 0;
    if (!search(rows, v, left, length)) break;
    natural = natural_residual(rows, v);
    if (!(left < near * smoothing_)) continue;
    smoothing_ *= length == 1 ? after_whole : after_part;
    left = residual(rows, v);
  }
  smoothing_ = 0;
  step_.setZero(row_count(rows));
  take_step(rows, v, 1);  // to what the laws allow
  natural = natural_residual(rows, v);
  round.solved = natural < enough_fall * residual_before;
  if (round.solved) return round;
  restore_impulses_and_biases(path_kept_, rows);
  v = path_start_;
  return round;
}

}  // namespace pbd
