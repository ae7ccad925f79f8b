// The references, as the program's commands see them.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "harness/cases.h"
#include "judge.h"
#include "rigid_step.h"
#include "scene.h"
#include "step_claim.h"

namespace pbdcheck {

/// Names of the references that solve a step; those of `contact_judges()`, which know contact, come last.
std::vector<std::string> reference_names();

/// Names of the references of motions: the ODE where there is one, and the solver's own by far smaller steps.
const std::vector<std::string>& motion_reference_names();

/// Both.
std::vector<std::string> all_reference_names();

bool knows_contact(const std::string& reference);

/// The first of them that knows the scene's effects and the integrator: with contact, damping or bounds of
/// forces, and of other steps than implicit Euler's, a judge of contact.
std::string default_reference(const pbd::Scene& scene, const std::string& integrator = "implicit_euler");

/// What a reference says about one step.
struct Judged {
  pbd::Points x;       // places at the end, m; what was reached of nodes if not ok
  pbd::State end;      // likewise
  std::string status;  // ok, not_converged or not_judged
  std::string reason;  // empty if ok
  int iterations = 0;
  double seconds = 0;
  double residual = 0;
  double claim_residual = std::nan("");  // reference/judge.h
};

/// The step of h seconds from `state` by a reference, its contacts by the law `friction`: implicit Euler's,
/// or by a reference that knows contact that of a `map`. Throws SetupError for a name that is not one of
/// `reference_names()`.
Judged judge_step(const std::string& name, const pbd::Scene& scene, const pbd::State& state, double h,
                  pbd::Friction friction = pbd::Friction::coulomb,
                  const pbd::reference::IntegratorMap* map = nullptr);

/// The same by a judge of contact that starts from what a step claims.
Judged judge_near(const std::string& name, const pbd::reference::StepClaim& claim, bool features_kept,
                  const pbd::reference::IntegratorMap* map = nullptr);

/// The implicit Euler step by primal_newton, for comparing with: throws std::runtime_error with the judge's
/// reason unless it was solved, Interrupted if the user asked to stop.
pbd::reference::Judgement truth(const pbd::Scene& scene, const pbd::State& state, double h);

/// The state before a case's step. Throws as `truth` does.
pbd::State start_of(const Case& each);

}  // namespace pbdcheck
