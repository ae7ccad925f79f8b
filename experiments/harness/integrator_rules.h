// Every integrator with the parameters it is measured with, and simulations by them.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/experiment.h"
#include "step/step.h"

namespace pbdcheck {

/// An integrator of the solver's list. The method solves linear problems directly and to rounding.
struct Rule {
  pbd::Method method;
  int order;  // of accuracy in h
  bool marginal =
      false;  // an error of a hard constraint's velocity comes back undiminished, with the other sign

  double alpha() const;      // NaN of all but newmark
  std::string name() const;  // with alpha, where there is one
};

/// All of them; newmark once for each alpha.
std::vector<Rule> integrator_rules(const std::vector<double>& alphas);

/// Steps done, and what became of them.
struct Simulation {
  pbd::State end;
  int steps = 0;  // that were not refused as diverged
  int steps_ok = 0;
  pbd::Status status = pbd::Status::ok;  // the worst of all steps
  std::string reason;                    // of the first step with that status
  double missed_residual = 0;            // the largest of the steps that are not ok
};

/// Called after each step with the states before and after; a text ends the simulation as diverged, with this
/// as its reason.
using AfterStep = std::function<std::string_view(const pbd::State& before, const pbd::State& after)>;

/// `steps` steps of h seconds from the scene's initial state, fewer if one diverges or says ok and is refuted
/// (`StepChecks`), which counts as diverged. Throws Interrupted.
Simulation simulate_steps(const pbd::Scene& scene, const pbd::Method& method, double h, int steps,
                          const AfterStep& after_step);

/// The cells integrator, alpha, outer, relaxation of a row.
std::vector<Cell> method_cells(const Rule& rule);

/// The cells status, reason of a row.
std::string status_cell(pbd::Status status);

}  // namespace pbdcheck
