#include "outer/automatic.h"

#include "outer/contraction.h"

namespace pbd {

Automatic::Automatic(StepSystem& system) : proximal_(system) {
  if (QuasiNewton::suits(system)) quasi_newton_.emplace(system);
}

void Automatic::begin(StepSystem& system) {
  slow_changes_ = 0;
  proximal_.begin(system);
  if (quasi_newton_) quasi_newton_->begin(system);
}

RowResidual Automatic::refresh(StepSystem& system) {
  return quasi_newton_ ? quasi_newton_->refresh(system) : linearise_at(system, system.at.v);
}

bool Automatic::plain_contracts(StepSystem& system, const Progress& progress) {
  constexpr double slow = 0.9;
  constexpr int patience = 2;
  if (progress.iterations_of_rows >= 2 && slow_changes_ < patience)
    slow_changes_ = progress.change > slow * progress.last_change ? slow_changes_ + 1 : 0;
  if (slow_changes_ >= patience) return false;  // for the rest of the step, whatever was predicted
  return system.problem.direction_blend != 1 || progress.contraction <= slow_contraction ||
         mass_.update(system, 1) <= slow_contraction;
}

void Automatic::iterate(StepSystem& system, Progress& progress) {
  if (quasi_newton_) return quasi_newton_->iterate(system, progress);
  if (!plain_contracts(system, progress)) return proximal_.iterate(system, progress);
  system.at.v = system.at.rebuilt;
  relax(system, progress);
}

void Automatic::forget() {
  slow_changes_ = 0;
  proximal_.forget();
  if (quasi_newton_) quasi_newton_->forget();
}

std::optional<RowResidual> Automatic::settle(StepSystem& system, const Progress& progress, bool stalled) {
  return quasi_newton_ ? quasi_newton_->settle(system, progress, stalled) : std::nullopt;
}

}  // namespace pbd
