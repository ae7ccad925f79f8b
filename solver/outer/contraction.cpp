#include "outer/contraction.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace pbd {

ContractionEstimate::ContractionEstimate(const StepSystem& system)
    : krylov_(most + 1, Points::Zero(3, system.problem.bodies.columns())),
      turned_x_(krylov_[0]),
      push_(krylov_[0]) {
  kept_.reserve(2 * row_count(system.rows));
}

namespace {

/// Of the scene, m.
double extent(const Problem& problem) {
  const Points& x = problem.map.x0;
  return std::max((x.rowwise().maxCoeff() - x.rowwise().minCoeff()).maxCoeff(),
                  problem.bodies.largest_radius());
}

/// True for rows with contacts, whose errors contradict each other where contacts are redundant, and a solver
/// that would try all it can to meet them.
bool factorises_contacts(const StepSystem& system) {
  return system.rows.contacts && (std::holds_alternative<Direct>(system.solver) ||
                                  std::holds_alternative<SemismoothNewton>(system.solver) ||
                                  std::holds_alternative<AugmentedLagrangian>(system.solver));
}

}  // namespace

/// What one plain iteration makes of a small error at v, with the rows linearised at v: the impulses push
/// along turned directions, and the rows miss what their value does beyond J.
std::int64_t ContractionEstimate::apply_plain(StepSystem& system, Points& error) {
  constexpr double turned = 1e-6;  // of the scene's extent: about the cube root of rounding
  const Problem& problem = system.problem;
  const StepMap& map = problem.map;
  const double scale = turned * extent(problem) / (map.d * error.colwise().norm().maxCoeff());
  turned_x_ = map.x0 + map.d * (system.at.v + scale * error);
  const Configuration turned_here = placed(problem, turned_x_, turned_poses_, problem.x_time);
  const Configuration* const where = directions_for(system, turned_x_);
  push_ = map.v_free;
  keep_impulses_and_biases(system.rows, kept_);
  const RowError rows_error{map, turned_here, where, system.at.v, scale, error, problem.inverse_mass};
  for (Slot& slot : system.slots) slot.source->perturb(rows_error, slot.blocks(system.rows), push_);
  add_gyroscopic(system, push_);
  error = (push_ - system.at.rebuilt) / scale;
  InnerBudget rough{.max_sweeps = 200, .relative = 1e-2};
  LinearSolver sweeping = GaussSeidel{};
  const bool sweeps_instead = factorises_contacts(system);
  if (sweeps_instead) rough.max_sweeps = 20;  // which cost less than one factorisation
  const std::int64_t sweeps =
      relax(sweeps_instead ? sweeping : system.solver, system.rows, error, true, rough, nullptr);
  restore_impulses_and_biases(kept_, system.rows);
  return sweeps;
}

void ContractionEstimate::begin_anywhere(const Problem& problem) {
  Points& first = krylov_[0];
  for (Eigen::Index k = 0; k < first.size(); ++k) first.reshaped()[k] = irregular(k + 1);
  for (std::size_t node = 0; node < problem.inverse_mass.size(); ++node)
    if (!(problem.inverse_mass[node] > 0)) first.col(node).setZero();
  first /= mass_norm(problem.inverse_mass, first);
}

/// Arnoldi's method: fills the matrix projected on the vectors; returns how many it used.
int ContractionEstimate::project(StepSystem& system, int count, Small& projected, Progress& progress) {
  const auto& inverse_mass = system.problem.inverse_mass;
  for (int used = 0; used < count; ++used) {
    Points& next = krylov_[used + 1];
    next = krylov_[used];
    const std::int64_t sweeps = apply_plain(system, next);
    progress.sweeps += sweeps;
    progress.row_updates += sweeps * row_count(system.rows);
    const double before = mass_norm(inverse_mass, next);
    for (int k = 0; k <= used; ++k) {
      projected(k, used) = mass_product(inverse_mass, krylov_[k], next);
      next -= projected(k, used) * krylov_[k];
    }
    const double left = mass_norm(inverse_mass, next);
    constexpr double exhausted = 1e-10;
    if (!(left > exhausted * before)) return used + 1;
    next /= left;
    if (used + 1 < count) projected(used + 1, used) = left;
  }
  return count;
}

void ContractionEstimate::update(StepSystem& system, bool bound_alone, Progress& progress) {
  if (system.problem.direction_blend != 1) return forget();
  const double tension = mass_.update(system, 1);
  value_ = std::max(tension, mass_.update(system, -1));
  if (bound_alone || !(value_ > slow_contraction) || !(extent(system.problem) > 0)) return;
  if (!mode_known_) begin_anywhere(system.problem);
  const int count = mode_known_ ? fewest : most;
  Small projected = Small::Zero(count, count);
  const int used = project(system, count, projected, progress);
  const Eigen::EigenSolver<Small> ritz(Small(projected.topLeftCorner(used, used)));
  int largest = 0;
  const double estimate = ritz.eigenvalues().cwiseAbs().maxCoeff(&largest);
  if (!std::isfinite(estimate)) return forget();
  value_ = std::min(value_, estimate);
  Points& mode = krylov_.back();
  mode.setZero();
  for (int k = 0; k < used; ++k) mode += ritz.eigenvectors()(k, largest).real() * krylov_[k];
  krylov_[0] = mode / mass_norm(system.problem.inverse_mass, mode);
  mode_known_ = true;
}

}  // namespace pbd
