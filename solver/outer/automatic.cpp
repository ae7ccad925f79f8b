#include "outer/automatic.h"

#include <algorithm>
#include <utility>

#include "outer/contraction.h"

namespace pbd {
namespace {

std::size_t contacts_with_friction(const Rows& rows) {
  std::size_t count = 0;
  for_each_block(rows.blocks, [&](const auto& block) { count += block.frictional() ? block.size() : 0; });
  return count;
}

}  // namespace

Automatic::Automatic(StepSystem& system) : proximal_(system) {
  if (QuasiNewton::suits(system)) quasi_newton_.emplace(system);
}

void Automatic::take_solver(StepSystem& system, std::size_t next) {
  std::swap(system.solver, solvers_[solver_]);
  std::swap(system.solver, solvers_[next]);
  solver_ = next;
  spent_ = 0;
}

void Automatic::begin(StepSystem& system) {
  slow_changes_ = spent_ = 0;
  uses_aitken_.reset();
  taken_over_ = takes_over_ = false;
  gain_ = of_aitken_ = {};
  take_solver(system, own);
  aitken_.begin(system);
  proximal_.begin(system);
  if (on_potential()) quasi_newton_->begin(system);
}

RowResidual Automatic::refresh(StepSystem& system) {
  return on_potential() ? quasi_newton_->refresh(system) : linearise_at(system, system.at.v);
}

/// True if plain's last two changes of v hardly fell: for the rest of the step, whatever is predicted.
bool Automatic::plain_is_slow(const Progress& progress) {
  constexpr double slow = 0.9;
  constexpr int patience = 2;
  if (progress.iterations_of_rows >= 2 && slow_changes_ < patience)
    slow_changes_ = progress.change > slow * progress.last_change ? slow_changes_ + 1 : 0;
  return slow_changes_ >= patience;
}

/// As predicted.
bool Automatic::plain_contracts(StepSystem& system, const Progress& progress) {
  return system.problem.direction_blend != 1 || progress.contraction <= slow_contraction ||
         mass_.update(system, 1) <= slow_contraction;
}

void Automatic::Gain::note(double residual) {
  if (residual < lowest / 2)
    *this = {.lowest = residual};
  else
    ++iterations_since;
}

/// Where its residual does not halve soon or grows far: proximal goes on with the step.
void Automatic::leave_aitken_without_gain(const Progress& progress) {
  constexpr int patience = 6;       // twice what the least share of a change needs to halve an error
  constexpr double too_much = 100;  // twice the digits by which proximal's acceleration is taken back
  of_aitken_.note(progress.residual());
  if (of_aitken_.iterations_since >= patience || !(progress.residual() <= too_much * of_aitken_.lowest))
    uses_aitken_ = false;
}

/// As far as the iterate tells that a step first asks at.
bool Automatic::contacts_stiffen_most(StepSystem& system) {
  mass_.update(system, 1);
  double contacts = 0, others = 0;
  for (const Slot& slot : system.slots) {
    double& largest = slot.source->kind().contacts ? contacts : others;
    largest = std::max(largest, slot.count > 0 ? slot.cost.contraction : 0);
  }
  return contacts > others;
}

void Automatic::take_over(StepSystem& system) {
  taken_over_ = takes_over_ = true;
  linearise_at(system, system.at.v);
}

/// True where quasi_newton is near the solution and comes no nearer, its elimination's rounding being met, or
/// takes many iterations down the potential, the fewer the farther it is.
bool Automatic::is_spent(const StepSystem& system, const Progress& progress) {
  constexpr double far = 1e-2;  // of the scale
  constexpr int patience = 10, many = 30, most = 60;
  const int enough = progress.residual() > far * progress.scale ? many : most;
  if (quasi_newton_->follows() && quasi_newton_->descends(system) && progress.iterations_of_rows >= enough)
    return true;
  gain_.note(progress.residual());
  return gain_.iterations_since >= patience && progress.residual() <= near * progress.scale;
}

bool Automatic::crowded(StepSystem& system, const Progress& progress) {
  constexpr std::int64_t many = 50, most = 1000;
  const auto pressed = quasi_newton_->pressed_contacts(system);
  return pressed > most || (pressed > many && quasi_newton_->follows() && plain_contracts(system, progress));
}

void Automatic::iterate(StepSystem& system, Progress& progress) {
  const std::int64_t before = progress.sweeps;
  if (on_potential() && (is_spent(system, progress) || crowded(system, progress))) take_over(system);
  progress.other_solver |= std::exchange(takes_over_, false);
  if (on_potential()) {
    quasi_newton_->iterate(system, progress);
  } else if (!plain_is_slow(progress) && plain_contracts(system, progress)) {
    system.at.v = system.at.rebuilt;
    relax(system, progress);
  } else {
    if (!uses_aitken_) uses_aitken_ = contacts_stiffen_most(system);
    if (*uses_aitken_) leave_aitken_without_gain(progress);
    if (*uses_aitken_)
      aitken_.iterate(system, progress);
    else
      proximal_.iterate(system, progress);
  }
  const Method& method = system.problem.method;
  spent_ = progress.sweeps - before >= method.max_sweeps ? spent_ + 1 : 0;
  if (method.relaxation != ConjugateGradients::name) return;
  if (const std::size_t next = successor(contacts_with_friction(system.rows)); next != solver_) {
    take_solver(system, next);
    progress.other_solver = true;
  }
}

/// Which solver goes on after the sweeps that were spent in a row on so many contacts; the same one if none.
std::size_t Automatic::successor(std::size_t contacts) const {
  constexpr int most_spent = 3;
  // On 27 boxes of the scene boxes_on_ground (130 contacts) direct is the quicker one, on all 125 (580)
  // sweeps.
  constexpr std::size_t few = 200;
  if (contacts == 0 || spent_ == 0) return solver_;
  if (solver_ == own && contacts <= few) return direct;
  if (spent_ < most_spent) return solver_;
  if (solver_ == own) return nesterov_jacobi;
  return solver_ == nesterov_jacobi ? gauss_seidel : solver_;
}

void Automatic::forget() {
  slow_changes_ = 0;
  gain_ = of_aitken_ = {};
  aitken_.forget();
  proximal_.forget();
  if (quasi_newton_) quasi_newton_->forget();
}

void Automatic::end(StepSystem& system) {
  if (quasi_newton_)
    quasi_newton_->end(system);
  else
    proximal_.end(system);
}

void Automatic::unsettle(StepSystem& system) {
  quasi_newton_->unsettle(system);
  if (leaves_) take_over(system);
}

std::optional<RowResidual> Automatic::settle(StepSystem& system, const Progress& progress, bool stalled) {
  leaves_ =
      progress.residual() <= near * progress.scale || (stalled && on_potential() && quasi_newton_->follows());
  return on_potential() ? quasi_newton_->settle(system, progress, stalled) : std::nullopt;
}

}  // namespace pbd
