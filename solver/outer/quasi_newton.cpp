#include "outer/quasi_newton.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "error.h"

namespace pbd {
namespace {

bool eliminates(const Slot& slot) {
  const Source::Kind& kind = slot.source->kind();
  return kind.compliant && !kind.of_bodies && !kind.contacts;
}

bool takes_local_contacts(const StepSystem& system) {
  return system.problem.method.relaxation != AugmentedLagrangian::name;
}

}  // namespace

QuasiNewton::QuasiNewton(StepSystem& system)
    : components_(system), lbfgs_(system.problem.method.memory), acceleration_(system.problem.method.memory) {
  const auto refuse = [](const char* what, const char* allowed) {
    throw SetupError("outer", std::string("quasi_newton ") + what, allowed);
  };
  if (system.problem.direction_blend != 1)
    refuse("with directions that are not those at x",
           "direction_blend 1 and an implicit integrator, or another outer iteration");
  for (Slot& slot : system.slots) {
    if (slot.count == 0) continue;
    const Source::Kind& kind = slot.source->kind();
    slot.eliminated = eliminates(slot);
    potential_.eliminated.insert(potential_.eliminated.end(), slot.count, slot.eliminated);
    follows_ |= slot.eliminated && !kind.fills_space;
    if (slot.eliminated) continue;
    if (kind.limited && !kind.contacts)
      refuse("with limits or motors of limited force", "another outer iteration");
    const Dual needed = kind.contacts ? Dual::contacts : Dual::hard_rows;
    if (dual_ != Dual::none && dual_ != needed)
      refuse("with contact beside joints or hard constraints", "another outer iteration");
    dual_ = needed;
  }
  if (dual_ == Dual::contacts && !takes_local_contacts(system))
    refuse("with contact by augmented_lagrangian", "another relaxation, or another outer iteration");
  const Bodies& bodies = system.problem.bodies;
  for (int b = 0; b < bodies.count(); ++b)
    bodies_move_ |= system.problem.inverse_mass[static_cast<std::size_t>(bodies.column(b))] > 0;
}

bool QuasiNewton::descends(const StepSystem& system) const {
  if (dual_ == Dual::hard_rows || bodies_move_) return false;
  return dual_ == Dual::none || row_count(system.rows, potential_.eliminated) == 0;
}

bool QuasiNewton::suits(const StepSystem& system) {
  if (system.problem.direction_blend != 1) return false;
  bool any = false;
  for (const Slot& slot : system.slots) {
    if (slot.count > 0 && slot.source->kind().contacts && !takes_local_contacts(system)) return false;
    if (slot.count == 0 || slot.source->kind().contacts) continue;
    if (!eliminates(slot)) return false;
    any = true;
  }
  return any;
}

void QuasiNewton::begin(StepSystem& system) {
  acceleration_.forget();
  lbfgs_.forget();
  evaluated_ = false;
  potential_.since_factor = 0;
  fall_ = {};
  // The last step's metric serves at first where line searches guard against it.
  last_residual_ = system.problem.method.warm_start && dual_ == Dual::none ? infinity : 0;
  if (std::exchange(pressed_, false)) potential_.metric.forget();
  potential_.begin_metric(system);
}

/// Counts an iteration. True if P is to be factored at the iterate: where rows leave directions free unless
/// the residual falls well enough, else after many iterations.
bool QuasiNewton::outlived(const Progress& progress, double well) {
  constexpr int most_iterations = 30;
  const double last = std::exchange(last_residual_, progress.residual());
  if (follows_) return !(progress.residual() <= well * last);
  return ++potential_.since_factor > most_iterations;
}

RowResidual QuasiNewton::evaluate(StepSystem& system) {
  evaluated_ = true;
  return sums_ = potential_.evaluate(system);
}

RowResidual QuasiNewton::refresh(StepSystem& system) {
  return evaluated_ ? sums_ : evaluate(system);
}

void QuasiNewton::iterate(StepSystem& system, Progress& progress) {
  if (descends(system))
    descend(system, progress);
  else
    project(system, progress);
}

/// Finds the direction at v; returns Newton's decrement, sqrt(-gradient . direction), an estimate of the
/// distance from the solution (sqrt(J)).
double QuasiNewton::find_direction() {
  const auto find = [this] {
    lbfgs_.direction(potential_.gradient, potential_.metric, direction_);
    slope_ = dot(potential_.gradient, direction_);
  };
  find();
  if (!(slope_ < 0)) {
    lbfgs_.forget();
    find();
  }
  return std::sqrt(-slope_);
}

/// Goes where the potential is lowest: the old velocity, the free one or rest of what has a finite mass. Not
/// above rest, where nothing is led, a step gains no energy but what the given forces bring: 1/2 |v -
/// v_free|^2 + U <= 1/2 |v_free|^2 + U_old. True if it moved.
bool QuasiNewton::start_low(StepSystem& system) {
  const Problem& problem = system.problem;
  Points& v = system.at.v;
  search_from_ = v;
  last_gradient_ = potential_.gradient;
  double lowest = potential_.value;
  const Points *last = &search_from_, *here = last;  // whose rows these are
  rest_ = problem.map.v_free;
  for (Eigen::Index column = 0; column < rest_.cols(); ++column)
    if (problem.inverse_mass[static_cast<std::size_t>(column)] > 0) rest_.col(column).setZero();
  for (const Points* start : {&problem.map.v_free, static_cast<const Points*>(&rest_)}) {
    if (start == &rest_ && lowest <= squared_mass_norm(problem.inverse_mass, problem.map.v_free) / 2) break;
    v = *start;
    evaluate(system);
    here = start;
    if (potential_.value < lowest) {
      lowest = potential_.value;
      search_from_ = v;
      last_gradient_ = potential_.gradient;
      last = start;
    }
  }
  const bool moved = last != &search_from_;
  if (moved && here != last) {
    v = search_from_;
    evaluate(system);
  }
  v = search_from_;
  potential_.gradient = last_gradient_;
  potential_.value = lowest;
  evaluated_ = moved;  // else the rows are still those of the last start
  return moved;
}

/// One line search down the potential along the direction found. Stays where no length gains anything. The
/// first iteration of a step goes where the potential is lowest.
void QuasiNewton::descend(StepSystem& system, const Progress& progress) {
  constexpr double sufficient = 1e-4;
  constexpr double flat = 1e-10, flatter = 0.8;  // where the potential's change is lost in its rounding
  constexpr int most_halvings = 30;
  if (progress.outer_iterations == 0) {
    if (start_low(system)) return;
    find_direction();
  }
  constexpr double well = 0.7;  // L-BFGS learns what the metric leaves out, and a factor would forget it
  if (outlived(progress, well)) {
    refresh(system);
    potential_.factor_metric(system, MetricShape::tangent);
    pressed_ = !follows_ && dual_ == Dual::contacts;
    lbfgs_.forget();
    find_direction();
  }
  Points& v = system.at.v;
  const double before = potential_.value;
  search_from_ = v;
  last_gradient_ = potential_.gradient;
  double length = 1;
  for (int k = 0; k < most_halvings; ++k, length /= 2) {
    v = search_from_ + length * direction_;
    evaluate(system);
    const double along = dot(potential_.gradient, direction_);
    if (potential_.value <= before + sufficient * length * slope_ ||
        (potential_.value <= (1 + flat) * before && along <= flatter * std::abs(slope_))) {
      lbfgs_.learn(v - search_from_, potential_.gradient - last_gradient_);
      return;
    }
  }
  v = search_from_;
  evaluate(system);
  lbfgs_.forget();
}

/// True if the iterate is so near to the solution that its impulses may be settled.
bool QuasiNewton::arrived(const StepSystem& system, const Progress& progress) {
  const double tolerance = system.problem.method.tolerance;
  if (!descends(system)) {
    constexpr int patience = 5;
    constexpr double near = 10;  // times the tolerance
    return fall_.iterations_since >= patience && progress.change <= near * tolerance * progress.scale;
  }
  constexpr double well = 0.5;
  fall_.note(progress.primal, well);
  // Settling is a step of Newton's method: it leaves of an error about its square.
  return find_direction() <= std::sqrt(tolerance) * progress.scale && fall_.iterations_since > 0;
}

/// Where nothing changes any velocity no impulse may be needed at all: what the eliminated rows answer is
/// rounding then.
std::optional<RowResidual> QuasiNewton::rest_as_it_is(StepSystem& system, const Progress& progress) {
  if (progress.scale > 0) return std::nullopt;
  search_from_ = system.at.v;
  clear_impulses(system.rows);
  evaluated_ = false;
  return linearise_at(system, system.at.v);
}

std::optional<RowResidual> QuasiNewton::settle(StepSystem& system, const Progress& progress, bool stalled) {
  if (dual_ == Dual::hard_rows) return std::nullopt;
  if (progress.outer_iterations == 0) return rest_as_it_is(system, progress);
  constexpr double inner_share = 0.3;  // of the tolerance, left to the linear rows
  const Problem& problem = system.problem;
  const bool last = progress.outer_iterations + 1 >= problem.method.max_outer;
  if (!arrived(system, progress) && !stalled && !last) return std::nullopt;
  search_from_ = system.at.v;
  linearise_at(system, system.at.v);
  last_gradient_ = system.at.v - system.at.rebuilt;
  weigh(problem.inverse_mass, last_gradient_);
  settling_.solve(inner_share * problem.method.tolerance * progress.scale, last_gradient_, potential_.metric,
                  system.rows, system.at.v);
  evaluated_ = false;
  return linearise_at(system, system.at.v);
}

void QuasiNewton::unsettle(StepSystem& system) {
  constexpr int wait = 5;  // iterations, until it is tried again
  fall_.iterations_since = descends(system) ? -wait : 0;
  system.at.v = search_from_;
  evaluate(system);
}

}  // namespace pbd
