#include "step_check.h"

#include <algorithm>
#include <cmath>

#include "contact_check.h"
#include "step_energy.h"

namespace pbd::reference {
namespace {

bool anything_moves(const Scene& scene) {
  return std::any_of(scene.mass.begin(), scene.mass.end(), [](double mass) { return std::isfinite(mass); }) ||
         std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [](const RigidBody& body) { return body.inertia.allFinite(); });
}

bool has_contact_rule(const StepClaim& claim) {
  return is_euler_step(claim) || claim.integrator == "newmark" || claim.integrator == "bdf2" ||
         claim.integrator == "generalised_alpha";
}

}  // namespace

StepCheck::StepCheck(const Scene& scene) {
  if (anything_moves(scene)) model_ = make_step_model(scene);
}

Findings StepCheck::judge(const StepClaim& claim) const {
  Findings findings;
  if (!model_) {
    findings.leave_out("all: nothing moves");
    return findings;
  }
  const double level = level_of(claim, *model_);
  if (is_euler_step(claim)) {
    check_motion(claim, Moved::all, findings);
    check_momentum(claim, *model_, level, findings);
    check_turns(claim, *model_, findings);
  } else {
    check_motion(claim, Moved::fixed, findings);
    findings.leave_out("motion of what moves, and momentum: by this integrator or blend of directions");
  }
  if (is_euler_step(claim) && !explicit_forces(claim))
    check_energy(claim, *model_, level, findings);
  else
    findings.leave_out("energy: by this integrator or blend of directions");
  if (claim.integrator == "midpoint" || claim.direction_blend != 1)
    findings.leave_out("constraints: by this integrator or blend of directions");
  else
    check_constraints(claim, *model_, level, findings);
  for (const Effect& effect : claim.scene.effects)
    if (const auto* contact = std::get_if<Contact>(&effect); contact != nullptr && has_contact_rule(claim)) {
      check_contacts(claim, *contact, level, findings);
      constexpr double overlooked = 1e-4;  // what is documented of the search of contacts
      check_depths(claim, *contact, level, overlooked, findings);
    }
  return findings;
}

}  // namespace pbd::reference
