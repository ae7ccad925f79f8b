#include "commands/simulation_totals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pbdcheck {

bool WorstStep::is_less_than(const pbd::Report& report) const {
  return step == 0 || (!std::isnan(residual) && !(report.residual() <= residual));
}

std::string WorstStep::text() const {
  if (std::isnan(residual)) return fmt::format("step {} without a finite residual", step);
  const auto most =
      (constraint.empty() ? "" : ", most of it of " + constraint) + (reason.empty() ? "" : ": " + reason);
  if (std::isinf(residual)) return fmt::format("the worst where nothing moves (step {}{})", step, most);
  return fmt::format("the worst with {:.3g} (step {}{})", residual, step, most);
}

void SimulationTotals::add(const pbd::Report& report, int parts,
                           const std::function<std::string(const pbd::ConstraintIndex&)>& name) {
  ++steps;
  steps_in_parts += parts > 1;
  most_parts = std::max(most_parts, parts);
  ++by_status[static_cast<std::size_t>(report.status)];
  outer_iterations += report.outer_iterations;
  sweeps += report.sweeps;
  row_updates += report.row_updates;
  const auto take = [&](WorstStep& own) {
    if (own.is_less_than(report))
      own = {report.residual(), steps, report.worst ? name(*report.worst) : "", std::string(report.reason)};
  };
  take(worst);
  if (report.status != pbd::Status::ok) take(worst_missed);
}

nlohmann::ordered_json report_json(const SimulationTotals& totals, const pbd::Workspace& workspace) {
  auto steps = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < totals.by_status.size(); ++i)
    steps[std::string(pbd::status_names[i])] = totals.by_status[i];
  auto effects = nlohmann::ordered_json::array();
  for (const auto& cost : workspace.costs())
    effects.push_back(
        {{"effect", cost.effect}, {"rows", cost.rows}, {"bytes", cost.bytes}, {"seconds", cost.seconds}});
  return {{"steps", totals.steps},
          {"steps_by_status", steps},
          {"worst_residual", totals.worst.residual},
          {"worst_step", totals.worst.step},
          {"worst_constraint", totals.worst.constraint},
          {"steps_in_parts", totals.steps_in_parts},
          {"most_parts", totals.most_parts},
          {"outer_iterations", totals.outer_iterations},
          {"sweeps", totals.sweeps},
          {"row_updates", totals.row_updates},
          {"effects", effects}};
}

}  // namespace pbdcheck
