#include <utility>

#include "outer/quasi_newton.h"

namespace pbd {

/// One proximal step in the metric: down the gradient, under the rows that are left dual.
void QuasiNewton::project(StepSystem& system, Progress& progress) {
  constexpr int patience = 5;  // iterations without a fall of the residual, from which nothing is learnt
  // What folds has many stationary shapes near it, between which accelerations would leap to and fro.
  const bool refuted =
      follows_ ? acceleration_.refuted(system, progress, 1) : acceleration_.refuted(system, progress);
  if (refuted) evaluate(system);
  fall_.note(progress.residual());
  if (fall_.iterations_since > patience) {
    acceleration_.forget();
    fall_ = {.lowest = progress.residual()};
  }
  acceleration_.note(system);
  constexpr double well = 0.1;  // Anderson's acceleration makes up for little of what is not convex
  if (outlived(progress, well)) {
    potential_.factor_metric(system, MetricShape::convex);
    pressed_ = !follows_;
    if (pressed_) acceleration_.forget();  // a sheet's metric changes too often to begin anew with each
  }
  const double accuracy = inner_accuracy(system.problem.method, progress);
  search_from_ = system.at.v;
  potential_.metric.solve(potential_.gradient, direction_);
  system.at.v -= direction_;
  const int most = system.problem.method.max_sweeps;
  std::int64_t sweeps = 0;
  if (dual_ == Dual::contacts) {
    const bool fresh = std::exchange(progress.other_solver, false) || progress.iterations_of_rows == 0;
    sweeps = contacts_.solve(system.solver, system.rows, potential_.eliminated, potential_.metric, fresh,
                             {.max_sweeps = most, .absolute = accuracy}, system.at.v);
    progress.linear_part = part(system.solver);
  } else {
    sweeps =
        hard_rows_.solve(system.rows, potential_.eliminated, potential_.metric, accuracy, most, system.at.v);
  }
  progress.sweeps += sweeps;
  progress.row_updates += sweeps * row_count(system.rows, potential_.eliminated);
  evaluated_ = false;
  constexpr double far = 1e-2;  // of the scale; nearer, the residual is the better judge
  const bool has_merit = dual_ == Dual::contacts && !system.problem.implicit_gyroscopic;
  if (has_merit && progress.residual() > far * progress.scale)
    search(system);
  else
    acceleration_.accelerate(system);
}

/// Goes as the acceleration leads, or to the image, or a part of the way there: to the first of these where
/// the merit is at most twice that at the start, or else to the image. A part of the way keeps its impulses.
void QuasiNewton::search(StepSystem& system) {
  constexpr int most_halvings = 5;
  const std::vector<bool>& eliminated = potential_.eliminated;
  Points& v = system.at.v;
  merit_.begin(system.rows, eliminated, potential_.value, search_from_);
  ContactMerit::find_sliding(system.rows, eliminated, v, at_image_);
  const auto leaps = [&](const ContactMerit::Sliding& sliding, double share) {
    evaluate(system);
    return merit_.leaps(system.rows, eliminated, potential_.value, v, sliding, share);
  };
  if (acceleration_.accelerate(system)) {
    ContactMerit::find_sliding(system.rows, eliminated, v, at_accelerated_);
    if (!leaps(at_accelerated_, 1)) return;
    acceleration_.reject(system);
  }
  image_ = v;
  if (!leaps(at_image_, 1)) return;
  direction_ = image_ - search_from_;
  double length = 0.5;
  for (int k = 0; k < most_halvings; ++k, length /= 2) {
    v = search_from_ + length * direction_;
    if (leaps(at_image_, length)) continue;
    acceleration_.forget();
    return;
  }
  v = image_;
  evaluate(system);
}

}  // namespace pbd
