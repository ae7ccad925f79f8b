#include "harness/integrator_rules.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "harness/interrupt.h"
#include "harness/step_checks.h"
#include "step/integrators.h"

namespace pbdcheck {

using namespace pbd;

double Rule::alpha() const {
  return method.integrator == "newmark" ? method.alpha : std::nan("");
}

std::string Rule::name() const {
  return method.integrator == "newmark" ? fmt::format("newmark {:g}", method.alpha) : method.integrator;
}

std::vector<Rule> integrator_rules(const std::vector<double>& alphas) {
  std::vector<Rule> all;
  for (const auto& integrator : integrators()) {
    Rule rule{.method = {}, .order = integrator.order};
    rule.method.integrator = integrator.name;
    rule.method.relaxation = "direct";
    rule.method.tolerance = 1e-12;
    rule.marginal = integrator.name == "midpoint";
    if (integrator.name != "newmark") {
      all.push_back(rule);
      continue;
    }
    for (const double alpha : alphas) {
      rule.method.alpha = alpha;
      rule.order = alpha == 0.5 ? 2 : 1;
      rule.marginal = alpha == 0.5;
      all.push_back(rule);
    }
  }
  return all;
}

Simulation simulate_steps(const Scene& scene, const Method& method, double h, int steps,
                          const AfterStep& after_step) {
  Simulation found;
  found.end = scene.initial;
  Workspace workspace(scene, method);
  StepChecks checks;
  while (found.steps < steps) {
    throw_if_interrupted();
    const State before = found.end;
    const Report report = step(workspace, h, found.end);
    found.steps_ok += report.status == Status::ok;
    if (report.status != Status::ok)
      found.missed_residual = std::max(found.missed_residual, report.residual());
    if (report.status > found.status) found.status = report.status, found.reason = report.reason;
    if (report.status == Status::diverged) break;
    ++found.steps;
    std::string stop(after_step(before, found.end));
    checks.add(found.steps, claim_of(scene, workspace, before, found.end, h, report), report.status, false);
    if (checks.refuted_steps() > 0) stop = checks.text();
    if (!stop.empty()) {
      found.status = Status::diverged;
      found.reason = stop;
      break;
    }
  }
  return found;
}

std::vector<Cell> method_cells(const Rule& rule) {
  return {rule.method.integrator, rule.alpha(), rule.method.outer, rule.method.relaxation};
}

std::string status_cell(Status status) {
  return std::string(status_names[static_cast<std::size_t>(status)]);
}

}  // namespace pbdcheck
