// Do the two judges agree on every scene the experiments use? They share the energies and differ in method.
#include "judge.h"

#include <cmath>

#include <fmt/format.h>

#include "experiments.h"
#include "judges.h"
#include "measure.h"

namespace pbdcheck {
namespace {

using namespace pbd;

/// Every step that an experiment compares with a judge, named by experiment and scene.
std::vector<Case> all_cases(bool full) {
  std::vector<Case> all;
  for (const auto& experiment : experiments())
    if (experiment.cases)
      for (Case& each : experiment.cases(full)) {
        each.name = fmt::format("{}: {}", experiment.name, each.name);
        all.push_back(std::move(each));
      }
  return all;
}

}  // namespace

void judges(Context& context) {
  const auto all = all_cases(context.full());
  context.begin(std::ssize(all));
  Table table =
      context.table("agreement", {"scene", "nodes", "step_s", "reference_a", "reference_b", "difference",
                                  "residual_a", "residual_b", "wall_s_a", "wall_s_b", "status", "reason"});
  Worst worst;
  for (const auto& each : all) {
    const State state = start_of(each);
    const auto a = reference::find_judge("primal_newton")(each.scene, state, each.h);
    const auto b = reference::find_judge("ipopt")(each.scene, state, each.h);
    const double difference = relative_error(b.x, a.x, state.x);
    const auto& failed = a.outcome == reference::Outcome::ok ? b : a;
    table.row({each.name, std::int64_t{each.scene.nodes()}, each.h, "primal_newton", "ipopt", difference,
               a.residual, b.residual, a.seconds, b.seconds,
               std::string(reference::outcome_names[static_cast<std::size_t>(failed.outcome)]),
               failed.reason});
    const bool both = a.outcome == reference::Outcome::ok && b.outcome == reference::Outcome::ok;
    worst.add(both ? difference : infinity);
    context.advance(each.name);
  }
  context.verdict("judges.agreement", "primal_newton and ipopt find the same step on every scene",
                  "largest difference relative to the step's largest displacement", worst.value(), 1e-9);
  table.close();
}

}  // namespace pbdcheck
