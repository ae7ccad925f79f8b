#include "harness/judges.h"

#include <cmath>
#include <stdexcept>

#include "error.h"
#include "harness/interrupt.h"
#include "harness/measure.h"
#include "primal_newton.h"
#include "scenes/choices.h"

namespace pbdcheck {

using pbd::reference::Outcome;

std::vector<std::string> reference_names() {
  std::vector<std::string> names;
  for (const auto& judge : pbd::reference::judges()) names.emplace_back(judge.name);
  return names;
}

Judged judge_step(const std::string& name, const pbd::Scene& scene, const pbd::State& state, double h) {
  const auto& all = pbd::reference::judges();
  for (const auto& judge : all)
    if (name.empty() || judge.name == name) {
      auto judged = judge.judge(scene, state, h);
      if (judged.outcome == Outcome::ok && !(judged.x.allFinite() && std::isfinite(judged.residual))) {
        judged.outcome = Outcome::not_converged;
        judged.reason = "not finite";
      }
      return {judged.outcome == Outcome::ok ? places(scene, judged.x, judged.orientation) : judged.x,
              std::string(pbd::reference::outcome_names[static_cast<std::size_t>(judged.outcome)]),
              judged.reason,
              judged.iterations,
              judged.seconds,
              judged.residual};
    }
  throw pbd::SetupError("--reference", "`" + name + "`", allowed_names(name, reference_names()));
}

pbd::reference::Judgement truth(const pbd::Scene& scene, const pbd::State& state, double h) {
  pbd::reference::NewtonSettings polled;
  polled.observer = [](double, const pbd::Points&) { throw_if_interrupted(); };
  auto judged = pbd::reference::primal_newton(scene, state, h, polled);
  if (judged.outcome != Outcome::ok)
    throw std::runtime_error("primal_newton found no step to compare with: " + judged.reason);
  return judged;
}

pbd::State start_of(const Case& each) {
  pbd::State state = each.scene.initial;
  for (int k = 0; k < each.lead_steps; ++k) {
    const auto judged = truth(each.scene, state, each.lead_step);
    state = {state.time + each.lead_step, judged.x, judged.v, judged.orientation, judged.spin};
  }
  return state;
}

}  // namespace pbdcheck
