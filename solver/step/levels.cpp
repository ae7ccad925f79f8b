#include "step/levels.h"

#include <algorithm>
#include <cmath>

#include "rows/laws.h"
#include "rows/mass_norm.h"

namespace pbd {
namespace {

/// The rounding of one constraint does not excuse another.
bool dual_met(const Method& method, const Levels& levels, const Progress& progress) {
  const double asked = method.tolerance * progress.scale;
  return progress.dual <= asked || (progress.dual <= levels.dual_rounding &&
                                    levels.beyond_rounding <= std::max(asked, levels.velocity_rounding));
}

}  // namespace

void measure(const StepSystem& system, const RowResidual& found, Levels& levels, Progress& progress) {
  const auto& inverse_mass = system.problem.inverse_mass;
  progress.dual = std::sqrt(found.squared);
  progress.primal = std::hypot(mass_distance(inverse_mass, system.at.v, system.at.rebuilt),
                               std::sqrt(system.at.torque_missed));
  progress.scale = mass_distance(inverse_mass, system.at.v, system.problem.start_v) + levels.free_change;
  const double impulses = std::sqrt(found.impulses_squared);
  const bool balance = progress.scale <= std::sqrt(rounding_unit) * impulses;  // to half of the digits
  levels.primal_rounding = 8 * rounding_unit * (levels.free_speed + (balance ? impulses : 0.0));
  levels.velocity_rounding = 8 * rounding_unit * levels.free_speed;
  levels.dual_rounding = levels.velocity_rounding + std::sqrt(found.rounding_squared);
  levels.beyond_rounding = std::sqrt(found.beyond_rounding_squared);
}

bool finished(const Method& method, const Levels& levels, const Progress& progress, Report& report) {
  constexpr double blown_up = 1e8;  // growth beyond any transient
  if (!std::isfinite(progress.primal) || !std::isfinite(progress.dual) || !std::isfinite(progress.scale)) {
    report.status = Status::diverged;
    report.reason = not_finite;
  } else if (progress.primal <= std::max(method.tolerance * progress.scale, levels.primal_rounding) &&
             dual_met(method, levels, progress)) {
    report.status = Status::ok;
    report.reason = "";
  } else if (progress.residual() > blown_up * levels.first) {
    report.status = Status::diverged;
    report.reason = "residual grew beyond 1e8 times its start and the scale there";
  } else {
    report.status = Status::not_converged;
    report.reason = "outer iterations spent";
    return progress.outer_iterations >= method.max_outer;
  }
  return true;
}

std::optional<ConstraintIndex> worst_constraint(const StepSystem& system) {
  std::optional<ConstraintIndex> worst;
  double most = 0;
  for (const Slot& slot : system.slots) {
    if (slot.eliminated) continue;  // its impulses are what its rows ask for
    std::size_t before = 0;         // of the slot's constraints
    for_each_block(slot.view(system.rows), [&](const auto& block) {
      for (std::size_t i = 0; i < block.size(); ++i) {
        const double missed = squared_residual(block, i, block.residual(system.at.v, i, block.impulse[i]));
        if (!(missed > most)) continue;
        most = missed;
        worst = {slot.effect, slot.source->kind().contacts ? before + i : block.entry(i)};
      }
      before += block.size();
    });
  }
  return worst;
}

}  // namespace pbd
