#include "harness/step_checks.h"

#include <fmt/format.h>

namespace pbdcheck {

pbd::reference::StepClaim claim_of(const pbd::Scene& scene, const pbd::Workspace& workspace,
                                   const pbd::State& start, const pbd::State& end, double h,
                                   const pbd::Report& report) {
  const pbd::Method& method = workspace.method();
  pbd::reference::StepClaim claim{.scene = scene, .start = start, .end = end, .h = h};
  claim.integrator = method.beta ? "newmark's own family" : std::string_view(method.integrator);
  claim.friction = pbd::friction_by_name(method.friction);
  claim.direction_blend = method.direction_blend;
  claim.tolerance = method.tolerance;
  claim.scale = report.scale;
  for (std::size_t effect = 0; effect < scene.effects.size(); ++effect)
    claim.forces.push_back(workspace.forces(effect));
  for (const pbd::ContactForce& each : workspace.contacts()) {
    claim.contacts.push_back({each.collider, each.point, each.normal, each.force, each.gap});
    if (each.met) claim.contacts.back().met = {each.met->arm, each.met->rotation};
  }
  return claim;
}

void StepChecks::add(std::int64_t step, const pbd::reference::StepClaim& claim, pbd::Status status,
                     bool changes) {
  if (status != pbd::Status::ok) {
    ++missed_;
    return;
  }
  if (!check_ || changes) check_.emplace(claim.scene);
  const auto findings = check_->judge(claim);
  ++judged_;
  compared_ += findings.compared;
  for (const auto& [reason, count] : findings.left_out) left_out_[reason] += count;
  refuted_steps_ += findings.refuted.empty() ? 0 : 1;
  for (const auto& finding : findings.refuted) refuted_.push_back({step, finding});
}

std::string StepChecks::text() const {
  std::string left_out;
  for (const auto& [reason, count] : left_out_)
    left_out += (left_out.empty() ? "; not judged: " : ", ") + reason;
  const std::string missed = missed_ > 0 ? fmt::format(" ({} missed their tolerance)", missed_) : "";
  if (compared_ == 0 && judged_ > 0)
    return fmt::format("checked: nothing of {} steps{}{}", judged_, missed, left_out);
  if (refuted_.empty())
    return fmt::format("checked: {} steps by {} numbers, none refuted{}{}", judged_, compared_, missed,
                       left_out);
  const auto& [step, finding] = refuted_.front();
  return fmt::format("refuted: {} of {} steps{}, the first at step {}: {} off by {:.3g} (allowed {:.3g}; {})",
                     refuted_steps_, judged_, missed, step, finding.check, finding.number, finding.bound,
                     finding.what);
}

}  // namespace pbdcheck
