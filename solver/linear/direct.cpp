#include "linear/direct.h"

#include <algorithm>

#include "linear/gauss_seidel.h"
#include "linear/natural_residual.h"

namespace pbd {

void Direct::begin(Rows& rows, const Points& v, bool fresh) {
  part_ = rows.contacts ? SemismoothNewton::name : Ldlt::name;
  if (!rows.contacts) return ldlt_.begin(rows, v, fresh);
  newton_.begin(rows, v, fresh);
  patience_ = fresh || !gave_up() ? most_patience : std::max(1, patience_ - 1);
  lowest_ = infinity;
  idle_ = 0;
  followed_ = false;
  further_sweeps_ = 0;
}

Sweep Direct::sweep(Rows& rows, Points& v, BlockSeconds seconds) {
  if (!rows.contacts) return ldlt_.sweep(rows, v, seconds);
  const double residual = natural_residual(rows, v);
  idle_ = residual < SemismoothNewton::enough_fall * lowest_ ? 0 : idle_ + 1;
  lowest_ = std::min(lowest_, residual);
  if (!(residual > 0) || gave_up()) return {residual, true};
  const bool augments = AugmentedLagrangian::applies(rows);
  part_ = SemismoothNewton::name;
  if (newton_.improve(rows, v, residual, augments ? 2 : 3)) return {residual};
  keep_impulses_and_biases(rows, kept_);
  start_ = v;
  if (augments ? augment(rows, v, residual)
               : idle_ > by_sweeps && (follow_path(rows, v, residual) || advance(rows, v)))
    return {residual};
  part_ = GaussSeidel::name;
  const int instead = 10 * (1 + idle_);
  for (int sweep = 0; sweep < instead; ++sweep) GaussSeidel{}.sweep(rows, v, nullptr);
  further_sweeps_ += instead;
  return {residual};
}

/// Puts back what was kept.
void Direct::restore(Rows& rows, Points& v) const {
  restore_impulses_and_biases(kept_, rows);
  v = start_;
}

bool Direct::augment(Rows& rows, Points& v, double residual) {
  part_ = AugmentedLagrangian::name;
  for (int call = 0; call <= idle_; ++call) {
    further_sweeps_ += augmented_.improve(rows, v);
    if (!(natural_residual(rows, v) < SemismoothNewton::enough_fall * residual)) continue;
    newton_.trust();
    return true;
  }
  restore(rows, v);
  return false;
}

/// By the path of smoothed laws: once, for its end depends on the rows alone.
bool Direct::follow_path(Rows& rows, Points& v, double residual) {
  if (followed_) return false;
  followed_ = true;
  const SemismoothNewton::Round path = newton_.follow_path(rows, v, residual);
  further_sweeps_ += path.factorisations;
  return path.solved;
}

/// By a round of the proximal point method. It need not lower the residual, but brings impulses nearer to
/// those that do.
bool Direct::advance(Rows& rows, Points& v) {
  const SemismoothNewton::Round round = newton_.advance(rows, v);
  further_sweeps_ += round.factorisations;
  if (!round.solved) restore(rows, v);
  return round.solved;
}

}  // namespace pbd
