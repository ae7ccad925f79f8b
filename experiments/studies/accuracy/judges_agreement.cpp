// Do the two judges agree on every scene the experiments use? They share the energies and differ in method.
// Where rigid bodies are joined, do they agree with the solver, too? A column under more load than a step's
// inertia bears has several solutions, and finds another: such steps are shown and not judged.
#include "judge.h"

#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "harness/judges.h"
#include "harness/measure.h"
#include "linear/linear_names.h"
#include "step/step.h"
#include "studies/experiments.h"

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

/// The solver's step as a judge states it.
reference::Judgement judged(const Case& each, State state) {
  Method method;
  method.relaxation = "direct";
  method.tolerance = 1e-13;
  method.max_outer = 1000;
  const auto start = std::chrono::steady_clock::now();
  Workspace workspace(each.scene, method);
  const Report report = step(workspace, each.h, state);
  reference::Judgement found;
  found.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  found.x = state.x;
  found.orientation = state.orientation;
  found.residual = larger(report.primal, report.dual) / report.scale;
  found.outcome = report.status == Status::ok ? reference::Outcome::ok : reference::Outcome::not_converged;
  found.reason = report.reason;
  return found;
}

/// Not a number where a judge left no state behind.
Points places_of(const Scene& scene, const reference::Judgement& found) {
  if (found.x.cols() == scene.nodes() && found.orientation.size() == scene.bodies.size())
    return places(scene, found.x, found.orientation);
  return Points::Constant(3, scene.nodes() + 3 * std::ssize(scene.bodies), std::nan(""));
}

/// Writes both and returns their difference, infinite where one failed.
double compare(Table& table, const Case& each, const State& start, const reference::Judgement& a,
               const reference::Judgement& b, std::string_view name_b) {
  const double difference = relative_error(places_of(each.scene, b), places_of(each.scene, a),
                                           places(each.scene, start.x, start.orientation));
  const bool first_ok = a.outcome == reference::Outcome::ok;
  const auto& failed = first_ok ? b : a;
  table.row({each.name, std::int64_t{each.scene.nodes()}, each.h, "primal_newton", std::string(name_b),
             difference, a.residual, b.residual, a.seconds, b.seconds,
             std::string(reference::outcome_names[static_cast<std::size_t>(failed.outcome)]), failed.reason});
  return first_ok && b.outcome == reference::Outcome::ok ? difference : infinity;
}

}  // namespace

void judges(Context& context) {
  const auto all = all_cases(context.full());
  context.begin(std::ssize(all));
  Table table =
      context.table("agreement", {"scene", "nodes", "step_s", "reference_a", "reference_b", "difference",
                                  "residual_a", "residual_b", "wall_s_a", "wall_s_b", "status", "reason"});
  Worst between_judges, of_solver;
  int certified = 0;  // steps of bodies that have one solution near the start
  for (const auto& each : all) {
    const State start = start_of(each);
    const auto newton = reference::find_judge("primal_newton")(each.scene, start, each.h);
    const auto ipopt = reference::find_judge("ipopt")(each.scene, start, each.h);
    between_judges.add(compare(table, each, start, newton, ipopt, "ipopt"));
    if (!each.scene.bodies.empty()) {
      const double difference = compare(table, each, start, newton, judged(each, start), "solver");
      if (newton.certified) of_solver.add(difference), ++certified;
    }
    context.advance(each.name);
  }
  context.verdict(
      Basis::code, "judges.agreement", "primal_newton and ipopt find the same step on every scene",
      "largest difference relative to the step's largest displacement", between_judges.value(), 1e-9);
  context.verdict(Basis::code, "judges.solver",
                  fmt::format("the solver finds the judges' step of rigid bodies where it is certified to be "
                              "regular ({} steps)",
                              certified),
                  "largest difference relative to the step's largest displacement", of_solver.value(), 1e-9);
  table.close();
}

}  // namespace pbdcheck
