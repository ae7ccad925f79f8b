// What breaks solvers: long and heavy ropes, stiffness ratios, collapsed and mirrored shapes, slivers, huge
// steps, other units. One method with no setting of its own for any case; the gates of gates.h as verdicts,
// and how far step and budget can be pushed before a gate fails.
#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include <fmt/format.h>

#include "error.h"
#include "experiments.h"
#include "gates.h"
#include "measure.h"
#include "mesh.h"
#include "scenes/standard.h"
#include "units.h"

namespace pbdcheck {
namespace {

using namespace pbd;

/// The default method; `direct` beside it where the scene has sweeps to do.
Method with_relaxation(const std::string& relaxation) {
  Method method;
  method.relaxation = relaxation;
  return method;
}

struct Frontier {
  double largest_step = std::nan("");    // s, up to which all gates hold
  double largest_solved = std::nan("");  // s, up to which every step is ok, too
  double fewest_sweeps = std::nan("");   // an outer iteration, from which on all gates hold
  std::int64_t passed = 0, tried = 0;    // runs of both ladders
};

struct Outcome {
  std::string scene;
  double h;  // s
  Method method;
  Simulated simulated;
  Frontier frontier;
  bool relaxes = true;  // false: the relaxation has no part in it
};

/// Largest step and fewest sweeps at which all gates hold, and at all milder ones.
Frontier frontier_of(const HardCase& each, const Method& method, bool full) {
  Frontier frontier;
  const Watch watch{full ? 20 : 10, full ? 500 : 150, 1};
  const auto run = [&](const Method& tried, double h) {
    const auto simulated = simulate(each, tried, h, watch);
    ++frontier.tried;
    frontier.passed += simulated.all_hold();
    return simulated;
  };
  const std::vector<double> all_steps{0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2};
  bool holds = true, solved = true;
  for (std::size_t i = 0; i < all_steps.size() && holds; i += full ? 1 : 3) {
    const auto simulated = run(method, all_steps[i]);
    holds = simulated.all_hold();
    solved = solved && holds && simulated.steps_ok == simulated.steps;
    if (holds) frontier.largest_step = all_steps[i];
    if (solved) frontier.largest_solved = all_steps[i];
  }
  const std::vector<int> sweeps = full ? std::vector{1000, 300, 100, 30, 10, 3, 1} : std::vector{1000, 30, 1};
  holds = true;
  for (std::size_t i = 0; i < sweeps.size() && holds; ++i) {
    Method tried = method;
    tried.max_sweeps = sweeps[i];
    const auto simulated = run(tried, each.h);
    holds = simulated.all_hold();
    if (holds && simulated.sweeps == 0) frontier.fewest_sweeps = 0;
    if (!holds || simulated.sweeps == 0) break;
    frontier.fewest_sweeps = sweeps[i];
  }
  return frontier;
}

/// 1 if n and n + 1 outer iterations a step do not agree on whether the shape is recovered, else 0.
double parity(const HardCase& each, Method method, int budget, const Watch& watch) {
  std::array<bool, 2> recovered{};
  for (const std::size_t more : {0U, 1U}) {
    method.max_outer = budget + static_cast<int>(more);
    recovered[more] = simulate(each, method, each.h, watch).gates.back().holds();
  }
  return recovered[0] != recovered[1];
}

/// Each is tried as the one relaxation for all cases; the first is the default, which the verdicts are about,
/// and which alone the full tier watches longer.
constexpr std::array<const char*, 3> one_for_all{"conjugate_gradients", "direct", "gauss_seidel"};

std::vector<Outcome> outcomes_of(const HardCase& each, bool full_tier) {
  std::vector<Outcome> outcomes;
  for (const std::string relaxation : one_for_all) {
    const bool full = full_tier && relaxation == one_for_all[0];
    const Watch watch{full ? 100 : 20, full ? 5000 : 800, full ? 10 : 3};
    const Method method = with_relaxation(relaxation);
    Outcome outcome{each.name, each.h, method, simulate(each, method, each.h, watch), {}};
    if (each.rest.size() > 0) {
      const Watch unjudged{watch.steps, watch.most_steps, 0};
      auto& gates = outcome.simulated.gates;
      gates.push_back({"parity", parity(each, method, method.max_outer, unjudged), 0});
      gates.push_back({"parity_at_10", parity(each, method, 10, unjudged), 0});
    }
    outcome.relaxes = outcome.simulated.sweeps > 0;
    outcome.frontier = frontier_of(each, method, full);
    outcomes.push_back(std::move(outcome));
    if (!outcomes.back().relaxes) break;
  }
  return outcomes;
}

/// The same scene in nine systems of units: largest difference of the end positions from those in SI.
Outcome other_units(const std::string& name, const Scene& scene, const std::string& relaxation, int steps) {
  const Method method = with_relaxation(relaxation);
  Outcome outcome{"units: " + name, 1.0 / 60, method, {}, {}};
  const auto end_in = [&](double length, double mass) {
    const Scene scaled = in_units(scene, length, mass);
    Workspace workspace(scaled, method);
    State state = scaled.initial;
    for (int k = 0; k < steps; ++k) {
      const auto report = step(scaled, method, outcome.h, state, workspace);
      ++outcome.simulated.steps;
      outcome.simulated.steps_ok += report.status == Status::ok;
      outcome.simulated.sweeps += report.sweeps;
      if (report.status > outcome.simulated.worst)
        outcome.simulated.worst = report.status, outcome.simulated.reason = report.reason;
    }
    return Points(state.x / length);
  };
  const Points usual = end_in(1, 1);
  Worst difference;
  for (const double length : {1e-3, 1.0, 1e3})
    for (const double mass : {1e-6, 1.0, 1e6})
      difference.add(relative_error(end_in(length, mass), usual, scene.initial.x));
  outcome.simulated.gates.push_back({"units", difference.value(), 1e-9});
  outcome.relaxes = outcome.simulated.sweeps > 0;
  return outcome;
}

/// A rest shape without volume is refused before anything is computed.
Outcome flat_rest() {
  Outcome outcome{"flat rest tetrahedron", 1.0 / 60, Method{}, {}, {}};
  double accepted = 1;
  try {
    Scene scene;
    add_solid(scene, kuhn_grid({1, 1, 1}, Vec3(1, 1, 0)), 1000, {}, Strain::corotational);
  } catch (const SetupError&) {
    accepted = 0;
  }
  outcome.simulated.gates.push_back({"refused", accepted, 0});
  outcome.relaxes = false;
  return outcome;
}

std::string reason_of(const Simulated& simulated) {
  if (simulated.worst == Status::ok) return "";
  return fmt::format("{} of {} steps not ok; worst: {}", simulated.steps - simulated.steps_ok,
                     simulated.steps, simulated.reason);
}

void write_gates(Table& table, const Outcome& outcome) {
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

void write_frontier(Table& table, const Outcome& outcome) {
  const Frontier& f = outcome.frontier;
  if (f.tried == 0) return;
  const bool solved = f.largest_solved == f.largest_step && f.largest_step > 0;
  table.row({outcome.scene, outcome.method.outer, outcome.method.relaxation, f.largest_step, f.largest_solved,
             f.fewest_sweeps, f.passed, f.tried, solved ? "ok" : "not_converged",
             solved ? "" : "some steps do not reach the tolerance, or a gate fails"});
}

/// One verdict a kind of gate: the worst case under the default method against the kind's bound.
void give_verdicts(Context& context, const std::vector<Outcome>& outcomes) {
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
    if (any) context.verdict("hard." + name, statement, quantity, worst.value(), bound);
  }
}

}  // namespace

void point_hard_cases(Context& context) {
  const bool full = context.full();
  const auto cases = hard_cases(full);
  context.begin(std::ssize(cases));
  std::vector<std::vector<Outcome>> found(cases.size());
  std::mutex mutex;
  context.parallel(std::ssize(cases), [&](std::int64_t i) {
    const auto index = static_cast<std::size_t>(i);
    found[index] = outcomes_of(cases[index], full);
    const std::lock_guard lock(mutex);
    context.advance(cases[index].name);
  });
  std::vector<Outcome> outcomes;
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
