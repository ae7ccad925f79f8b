// What breaks solvers: long and heavy ropes, stiffness ratios, collapsed and mirrored shapes, slivers, huge
// steps, other units. One method with no setting of its own for any case; the gates of gates.h as verdicts,
// and how far step and budget can be pushed before a gate fails.
#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include <fmt/format.h>

#include "harness/measure.h"
#include "scenes/standard.h"
#include "studies/experiments.h"
#include "studies/robustness/point_outcomes.h"

namespace pbdcheck {
namespace {

using namespace pbd;

std::string reason_of(const Simulated& simulated) {
  if (simulated.worst == Status::ok) return "";
  return fmt::format("{} of {} steps not ok; worst: {}", simulated.steps - simulated.steps_ok,
                     simulated.steps, simulated.reason);
}

void write_gates(Table& table, const PointOutcome& outcome) {
  const auto& simulated = outcome.simulated;
  for (const Gate& gate : simulated.gates) {
    const bool skipped = !gate.skipped.empty();
    table.row({outcome.scene, outcome.h, outcome.method.integrator, outcome.method.outer,
               outcome.method.relaxation, simulated.steps, std::string(gate.name), gate.measured, gate.bound,
               skipped ? std::nan("") : static_cast<double>(gate.holds()),
               skipped ? "skipped" : std::string(status_names[static_cast<std::size_t>(simulated.worst)]),
               skipped ? gate.skipped : reason_of(simulated)});
  }
}

void write_frontier(Table& table, const PointOutcome& outcome) {
  const PointFrontier& f = outcome.frontier;
  if (f.tried == 0) return;
  const bool solved = f.largest_solved == f.largest_step && f.largest_step > 0;
  table.row({outcome.scene, outcome.method.outer, outcome.method.relaxation, f.largest_step, f.largest_solved,
             f.fewest_sweeps, f.passed, f.tried, solved ? "ok" : "not_converged",
             solved ? "" : "some steps do not reach the tolerance, or a gate fails"});
}

/// One verdict a kind of gate: the worst case under the default method against the kind's bound.
void give_verdicts(Context& context, const std::vector<PointOutcome>& outcomes) {
  static const std::vector<std::array<std::string, 3>> kinds{
      {"finite", "no coordinate ceases to be finite and no step diverges", "number"},
      {"energy", "energy never exceeds the start's and the work done",
       "excess, part of start + (m g + |f|) L"},
      {"hard_rows", "hard links keep their lengths", "largest error, part of the length"},
      {"claims", "a step that says ok is solved, as the judge finds",
       "largest residual, part of the allowed"},
      {"residual", "every step that gives up has improved on its start", "steps that have not"},
      {"settles", "what settles has settled by its time", "kinetic energy, part of m g L"},
      {"tension", "hanging ropes carry what hangs below", "largest relative error"},
      {"recovers", "random, flattened, collapsed and mirrored cubes recover", "worst node, part of L"},
      {"parity", "recovery is the same with 100 and 101 outer iterations", "1 if a cube differs"},
      {"parity_at_10", "recovery is the same with 10 and 11 outer iterations", "1 if a cube differs"},
      {"units", "results do not depend on the units", "largest difference, part of the displacement"},
      {"refused", "a rest shape without volume is refused", "number accepted"}};
  const std::string relaxation = one_for_all[0];
  for (const auto& [name, statement, quantity] : kinds) {
    Worst worst;
    double bound = 0;
    bool any = false;
    for (const auto& outcome : outcomes)
      for (const auto& gate : outcome.simulated.gates)
        if (gate.name == name && (outcome.method.relaxation == relaxation || !outcome.relaxes) &&
            gate.skipped.empty()) {
          worst.add(gate.measured);
          bound = gate.bound;
          any = true;
        }
    if (any) context.verdict(Basis::robustness, "hard." + name, statement, quantity, worst.value(), bound);
  }
}

}  // namespace

void point_hard_cases(Context& context) {
  const bool full = context.full();
  const auto cases = hard_cases(full);
  context.begin(std::ssize(cases));
  std::vector<std::vector<PointOutcome>> found(cases.size());
  std::mutex mutex;
  context.parallel(std::ssize(cases), [&](std::int64_t i) {
    const auto index = static_cast<std::size_t>(i);
    found[index] = outcomes_of(cases[index], full);
    const std::lock_guard lock(mutex);
    context.advance(cases[index].name);
  });
  std::vector<PointOutcome> outcomes;
  for (auto& some : found) std::move(some.begin(), some.end(), std::back_inserter(outcomes));
  const int steps = full ? 50 : 10;
  for (const std::string relaxation : one_for_all)
    outcomes.push_back(other_units("chain", chain(20, 10), relaxation, steps));
  outcomes.push_back(other_units("cloth", cloth(4), one_for_all[0], steps));
  outcomes.push_back(
      other_units("cantilever", cantilever(4, {1e6, 0.3}, Strain::corotational), one_for_all[0], steps));
  outcomes.push_back(flat_rest());

  Table gates = context.table("gates", {"scene", "step_s", "integrator", "outer", "relaxation", "steps",
                                        "gate", "measured", "bound", "holds", "status", "reason"});
  Table frontier =
      context.table("frontier", {"scene", "outer", "relaxation", "largest_step_s", "largest_solved_step_s",
                                 "fewest_sweeps", "runs_passed", "runs", "status", "reason"});
  for (const auto& outcome : outcomes) {
    write_gates(gates, outcome);
    write_frontier(frontier, outcome);
  }
  give_verdicts(context, outcomes);
  gates.close();
  frontier.close();
}

}  // namespace pbdcheck
