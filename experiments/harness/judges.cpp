#include "harness/judges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "error.h"
#include "harness/interrupt.h"
#include "harness/measure.h"
#include "harness/progress.h"
#include "primal_newton.h"
#include "scenes/choices.h"

namespace pbdcheck {

using pbd::reference::Outcome;

namespace {

Judged judged_of(const pbd::Scene& scene, const pbd::State& state, double h,
                 pbd::reference::Judgement judged) {
  if (judged.outcome == Outcome::ok && !(judged.x.allFinite() && std::isfinite(judged.residual))) {
    judged.outcome = Outcome::not_converged;
    judged.reason = "not finite";
  }
  const bool ok = judged.outcome == Outcome::ok;
  return {ok ? places(scene, judged.x, judged.orientation) : judged.x,
          {state.time + h, judged.x, judged.v, judged.orientation, judged.spin},
          std::string(pbd::reference::outcome_names[static_cast<std::size_t>(judged.outcome)]),
          judged.reason,
          judged.iterations,
          judged.seconds,
          judged.residual,
          judged.claim_residual};
}

/// Whether limits or limited forces are among its constraints.
bool bounded(const pbd::Effect& effect) {
  return std::visit(
      [](const auto& own) {
        if constexpr (requires { own.bounds; }) return !own.bounds.empty();
        return false;
      },
      effect);
}

/// Lets a judge's work be interrupted, and tells of what takes long.
std::function<void()> watched(const std::string& name, const pbd::State& state) {
  return
      [notice = SlowNotice(fmt::format("{} solves the step from t = {:.6g} s", name, state.time))]() mutable {
        throw_if_interrupted();
        notice.poll();
      };
}

/// Null if there is none of that name.
pbd::reference::ContactJudge contact_judge(const std::string& name) {
  for (const auto& judge : pbd::reference::contact_judges())
    if (judge.name == name) return judge.judge;
  return nullptr;
}

}  // namespace

std::vector<std::string> reference_names() {
  std::vector<std::string> names;
  for (const auto& judge : pbd::reference::judges()) names.emplace_back(judge.name);
  for (const auto& judge : pbd::reference::contact_judges()) names.emplace_back(judge.name);
  return names;
}

const std::vector<std::string>& motion_reference_names() {
  static const std::vector<std::string> names{"ode", "finer_steps"};
  return names;
}

std::vector<std::string> all_reference_names() {
  auto names = reference_names();
  names.insert(names.end(), motion_reference_names().begin(), motion_reference_names().end());
  return names;
}

bool knows_contact(const std::string& reference) {
  return contact_judge(reference) != nullptr;
}

std::string default_reference(const pbd::Scene& scene, const std::string& integrator) {
  const bool beyond_equations =
      integrator != "implicit_euler" ||
      std::any_of(scene.effects.begin(), scene.effects.end(), [](const pbd::Effect& effect) {
        return std::holds_alternative<pbd::Contact>(effect) || pbd::damped(effect) || bounded(effect);
      });
  return std::string(beyond_equations ? pbd::reference::contact_judges()[0].name
                                      : pbd::reference::judges()[0].name);
}

Judged judge_step(const std::string& name, const pbd::Scene& scene, const pbd::State& state, double h,
                  pbd::Friction friction, const pbd::reference::IntegratorMap* map) {
  for (const auto& judge : pbd::reference::judges())
    if (judge.name == name) return judged_of(scene, state, h, judge.judge(scene, state, h));
  if (const auto judge = contact_judge(name))
    return judged_of(scene, state, h,
                     judge(scene, state, h, friction, {.poll = watched(name, state), .map = map}));
  throw pbd::SetupError("--reference", "`" + name + "`", allowed_names(name, reference_names()));
}

Judged judge_near(const std::string& name, const pbd::reference::StepClaim& claim, bool features_kept,
                  const pbd::reference::IntegratorMap* map) {
  if (const auto judge = contact_judge(name))
    return judged_of(claim.scene, claim.start, claim.h,
                     judge(claim.scene, claim.start, claim.h, claim.friction,
                           {.near = &claim,
                            .features_kept = features_kept,
                            .poll = watched(name, claim.start),
                            .map = map}));
  throw pbd::SetupError("--reference", "`" + name + "`", "a judge of contact");
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
