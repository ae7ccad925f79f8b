// What breaks contact solvers: mass ratios, redundant contacts, thresholds of sliding, high friction, chains
// that strike. One method with no setting of its own for any case; its gates are in contact_gates.h.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "harness/measure.h"
#include "studies/experiments.h"
#include "studies/robustness/contact_gates.h"

namespace pbdcheck {
namespace {

using namespace pbd;

struct Frontier {
  double largest_step = std::nan("");   // s, of those tried at which all gates hold
  double fewest_sweeps = std::nan("");  // an outer iteration, at the case's own step
};

/// Longer steps and fewer sweeps while the gates hold; where they do not hold as it is, shorter steps until
/// they do. What is soft takes long: its steps alone, in the full tier.
Frontier contact_frontier(const ContactCase& each, const Method& method, bool holds, bool full) {
  Frontier frontier;
  const bool soft = each.family == "soft";
  if (holds) frontier.largest_step = each.h;
  if (soft && !full) return frontier;
  if (holds) {
    for (const double factor : {2.0, 4.0, 8.0}) {
      if (!all_hold(run_contact_case(each, method, factor * each.h).gates)) break;
      frontier.largest_step = factor * each.h;
    }
    if (soft) return frontier;
    frontier.fewest_sweeps = method.max_sweeps;
    for (const int most : {100, 30, 10, 3, 1}) {
      Method tried = method;
      tried.max_sweeps = most;
      if (!all_hold(run_contact_case(each, tried, each.h).gates)) break;
      frontier.fewest_sweeps = most;
    }
    return frontier;
  }
  for (const double factor : {0.5, 0.25})
    if (all_hold(run_contact_case(each, method, factor * each.h).gates)) {
      frontier.largest_step = factor * each.h;
      break;
    }
  return frontier;
}

/// The first cases meet all bounds. Of the others most bounds are goals: what must never fail are claims and
/// known answers, and energy and places that blow up.
Basis basis_of(std::string_view family, std::string_view gate) {
  if (family.empty()) return Basis::robustness;
  for (const std::string_view wished :
       {"penetration", "penetration_at_end", "crosses", "passes", "joints", "residual", "settles"})
    if (gate == wished) return Basis::goal;
  return gate == "answer" ? Basis::theory : Basis::robustness;
}

/// A gate in a family of cases: its largest number and the bound there.
struct JudgedGate {
  std::string_view family, gate;
  double bound;
  Worst worst{};
};

}  // namespace

void contact_hard_cases(Context& context) {
  const std::vector<ContactCase> cases = contact_cases(context.full());
  std::vector<std::string> relaxations{"direct"};  // the one that is judged
  if (context.full()) relaxations.insert(relaxations.end(), {"conjugate_gradients", "gauss_seidel"});
  context.begin(std::ssize(cases));
  Table table = context.table(
      "gates", {"scene", "step_s", "integrator", "outer", "relaxation", "friction", "steps", "steps_ok",
                "sweeps", "gate", "measured", "bound", "holds", "status", "reason"});
  Table frontiers = context.table("frontier", {"scene", "outer", "relaxation", "friction", "largest_step_s",
                                               "fewest_sweeps", "status", "reason"});
  std::vector<JudgedGate> judged;
  for (const ContactCase& each : cases) {
    for (const std::string& relaxation : relaxations) {
      if (each.family == "soft" && relaxation != relaxations[0]) continue;  // for its time
      Method method;
      method.relaxation = relaxation;
      if (relaxation != relaxations[0]) method.max_outer = 10, method.max_sweeps = 100;
      const CaseRun run = run_contact_case(each, method, each.h);
      const std::string status(status_names[static_cast<std::size_t>(run.worst)]);
      for (const Gate& gate : run.gates) {
        if (!gate.skipped.empty()) continue;
        table.row({each.name, each.h, method.integrator, method.outer, relaxation, method.friction, run.steps,
                   run.ok, run.sweeps, std::string(gate.name), gate.measured, gate.bound,
                   std::int64_t{gate.holds()}, status, run.reason});
        if (relaxation != relaxations[0]) continue;
        const auto found = std::find_if(judged.begin(), judged.end(), [&](const JudgedGate& of) {
          return of.family == each.family && of.gate == gate.name;
        });
        JudgedGate& own = found != judged.end()
                              ? *found
                              : judged.emplace_back(JudgedGate{each.family, gate.name, gate.bound});
        own.worst.add(gate.measured, each.name);
      }
      if (relaxation != relaxations[0]) continue;
      const Frontier frontier = contact_frontier(each, method, all_hold(run.gates), context.full());
      frontiers.row({each.name, method.outer, relaxation, method.friction, frontier.largest_step,
                     frontier.fewest_sweeps, status, run.reason});
    }
    context.advance(each.name);
  }
  table.close();
  frontiers.close();
  for (const auto& [family, gate, bound, worst] : judged) {
    const std::string name = family.empty() ? "contact_hard" : fmt::format("contact_hard.{}", family);
    context.verdict(basis_of(family, gate), fmt::format("{}.{}", name, gate),
                    fmt::format("the gate {} holds in every case that asks for it", gate),
                    fmt::format("largest measured ({})", worst.owner()), worst.value(), bound);
  }
}

}  // namespace pbdcheck
