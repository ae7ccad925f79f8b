#include "step/levels.h"

#include <algorithm>
#include <cmath>

#include "rows/laws.h"
#include "rows/mass_norm.h"

namespace pbd {
namespace {

constexpr double some_roundings = 8 * rounding_unit;

/// Primal residual (sqrt(J)) of nodes and bodies beyond the rounding of what acts on each, and of the values
/// of its constraints where `still`, and what is missed of gyroscopic torques.
double beyond_own_rounding(const StepSystem& system, bool still, std::vector<double>& effects) {
  const auto& inverse_mass = system.problem.inverse_mass;
  effects.assign(inverse_mass.size(), 0);
  for (const Slot& slot : system.slots) {
    if (slot.eliminated) continue;  // its impulses are no part of the rounding
    for_each_block(slot.view(system.rows), [&](const auto& block) {
      for (std::size_t i = 0; i < block.size(); ++i) {
        const typename std::decay_t<decltype(block)>::Jacobian& jacobian = block.jacobian[i];
        const auto push = (jacobian.transpose() * block.impulse[i]).eval();
        double size = 0;  // m, of the constraint's places that move
        for (const int node : block.node[i])
          if (inverse_mass[static_cast<std::size_t>(node)] > 0)
            size = std::max(size, system.at.x.col(node).cwiseAbs().maxCoeff());
        const double of_value =  // of the impulse, over what rounding makes of velocities
            still ? block.inverse_diagonal[i].norm() * size / system.problem.map.d : 0;
        for (std::size_t a = 0; a < block.node[i].size(); ++a) {
          const auto node = static_cast<std::size_t>(block.node[i][a]);
          const auto first = 3 * static_cast<Eigen::Index>(a);
          effects[node] += inverse_mass[node] * (push.template segment<3>(first).norm() +
                                                 jacobian.template middleCols<3>(first).norm() * of_value);
        }
      }
    });
  }
  double sum = system.at.torque_missed;
  for (std::size_t node = 0; node < inverse_mass.size(); ++node) {
    if (!(inverse_mass[node] > 0)) continue;
    const auto column = static_cast<Eigen::Index>(node);
    const double missed = (system.at.v.col(column) - system.at.rebuilt.col(column)).norm();
    const double own = some_roundings * (effects[node] + system.problem.map.v_free.col(column).norm());
    if (!(missed <= own)) sum += missed * missed / inverse_mass[node];
  }
  return std::sqrt(sum);
}

/// What rounds impulses on one body or node does not excuse another.
bool primal_met(const Method& method, const Levels& levels, const Progress& progress) {
  const double asked = method.tolerance * progress.scale;
  return progress.primal <= asked || (progress.primal <= levels.primal_rounding &&
                                      levels.primal_beyond <= std::max(asked, levels.velocity_rounding));
}

/// The rounding of one constraint does not excuse another.
bool dual_met(const Method& method, const Levels& levels, const Progress& progress) {
  const double asked = method.tolerance * progress.scale;
  return progress.dual <= asked || (progress.dual <= levels.dual_rounding &&
                                    levels.beyond_rounding <= std::max(asked, levels.velocity_rounding));
}

}  // namespace

void measure(const StepSystem& system, const RowResidual& found, std::vector<double>& effects, Levels& levels,
             Progress& progress) {
  const auto& inverse_mass = system.problem.inverse_mass;
  progress.dual = std::sqrt(found.squared);
  progress.primal = std::hypot(mass_distance(inverse_mass, system.at.v, system.at.rebuilt),
                               std::sqrt(system.at.torque_missed));
  progress.scale = mass_distance(inverse_mass, system.at.v, system.problem.start_v) + levels.free_change;
  const double impulses = std::sqrt(found.impulses_squared);
  const bool balance = progress.scale <= std::sqrt(rounding_unit) * impulses;  // to half of the digits
  const double of_values = std::sqrt(found.rounding_squared);
  levels.velocity_rounding = some_roundings * levels.free_speed;
  const bool still = progress.scale <= levels.velocity_rounding + of_values;  // but for rounding
  levels.primal_rounding =
      levels.velocity_rounding + (balance ? some_roundings * impulses : 0.0) + (still ? of_values : 0.0);
  const bool missed = progress.primal > system.problem.method.tolerance * progress.scale;
  levels.primal_beyond = (balance || still) && missed ? beyond_own_rounding(system, still, effects) : 0.0;
  levels.dual_rounding = levels.velocity_rounding + of_values;
  levels.beyond_rounding = std::sqrt(found.beyond_rounding_squared);
}

bool finished(const Method& method, const Levels& levels, const Progress& progress, Report& report) {
  constexpr double blown_up = 1e8;  // growth beyond any transient
  if (!std::isfinite(progress.primal) || !std::isfinite(progress.dual) || !std::isfinite(progress.scale)) {
    report.status = Status::diverged;
    report.reason = not_finite;
  } else if (primal_met(method, levels, progress) && dual_met(method, levels, progress)) {
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
