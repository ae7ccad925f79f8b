#include "studies/robustness/point_outcomes.h"

#include "error.h"
#include "harness/measure.h"
#include "mesh.h"
#include "scenes/standard.h"
#include "studies/robustness/units.h"

namespace pbdcheck {
namespace {

using namespace pbd;

/// The default method; `direct` beside it where the scene has sweeps to do.
Method with_relaxation(const std::string& relaxation) {
  Method method;
  method.relaxation = relaxation;
  return method;
}

/// Largest step and fewest sweeps at which all gates hold, and at all milder ones.
PointFrontier frontier_of(const HardCase& each, const Method& method, bool full) {
  PointFrontier frontier;
  const Watch watch{full ? 20 : 10, full ? 500 : 150, 1};
  const auto run = [&](const Method& tried, double h) {
    auto simulated = simulate(each, tried, h, watch);
    ++frontier.tried;
    frontier.passed += all_hold(simulated.gates);
    return simulated;
  };
  const std::vector<double> all_steps{0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2};
  bool holds = true, solved = true;
  for (std::size_t i = 0; i < all_steps.size() && holds; i += full ? 1 : 3) {
    const auto simulated = run(method, all_steps[i]);
    holds = all_hold(simulated.gates);
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
    holds = all_hold(simulated.gates);
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

}  // namespace

std::vector<PointOutcome> outcomes_of(const HardCase& each, bool full_tier) {
  std::vector<PointOutcome> outcomes;
  for (const std::string relaxation : one_for_all) {
    const bool full = full_tier && relaxation == one_for_all[0];
    const Watch watch{full ? 100 : 20, full ? 5000 : 800, full ? 10 : 3};
    const Method method = with_relaxation(relaxation);
    PointOutcome outcome{each.name, each.h, method, simulate(each, method, each.h, watch), {}};
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

PointOutcome other_units(const std::string& name, const Scene& scene, const std::string& relaxation,
                         int steps) {
  const Method method = with_relaxation(relaxation);
  PointOutcome outcome{"units: " + name, 1.0 / 60, method, {}, {}};
  const auto end_in = [&](double length, double mass) {
    const Scene scaled = in_units(scene, length, mass);
    Workspace workspace(scaled, method);
    State state = scaled.initial;
    for (int k = 0; k < steps; ++k) {
      const auto report = step(workspace, outcome.h, state);
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

PointOutcome flat_rest() {
  PointOutcome outcome{"flat rest tetrahedron", 1.0 / 60, Method{}, {}, {}};
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

}  // namespace pbdcheck
