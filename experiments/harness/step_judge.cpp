#include "harness/step_judge.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/measure.h"

namespace pbdcheck {
namespace {

/// |v - v*|_M, sqrt(J): of what moves, rotations by their principal moments.
double velocity_distance(const pbd::Scene& scene, const pbd::State& one, const pbd::State& other) {
  double squared = 0;
  for (int i = 0; i < scene.nodes(); ++i)
    if (const double mass = scene.mass[static_cast<std::size_t>(i)]; std::isfinite(mass))
      squared += mass * (one.v.col(i) - other.v.col(i)).squaredNorm();
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const pbd::Vec3& inertia = scene.bodies[b].inertia;
    const auto body = static_cast<Eigen::Index>(b);
    if (inertia.allFinite()) squared += inertia.dot((one.spin.col(body) - other.spin.col(body)).cwiseAbs2());
  }
  return std::sqrt(squared);
}

/// True if what has no finite mass or inertia has the velocity with which it began.
bool keeps_fixed_velocities(const pbd::reference::StepClaim& claim) {
  const pbd::Scene& scene = claim.scene;
  const pbd::State &start = claim.start, &end = claim.end;
  for (int i = 0; i < scene.nodes(); ++i)
    if (std::isinf(scene.mass[static_cast<std::size_t>(i)]) && end.v.col(i) != start.v.col(i)) return false;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const auto body = static_cast<Eigen::Index>(b);
    if (!scene.bodies[b].inertia.allFinite() && end.spin.col(body) != start.spin.col(body)) return false;
  }
  return true;
}

StepDistance distance(const pbd::reference::StepClaim& claim, const Judged& judged) {
  if (judged.status != "ok") return {};
  const pbd::Points reached = places(claim.scene, claim.end.x, claim.end.orientation),
                    begin = places(claim.scene, claim.start.x, claim.start.orientation);
  const double metres = relative_error(reached, judged.x, judged.x),
               size = reached.cols() > 0 ? reached.cwiseAbs().maxCoeff() : 0;
  const double apart = velocity_distance(claim.scene, claim.end, judged.end);
  // Where nothing moves is no scale.
  return {relative_error(reached, judged.x, begin), metres,
          metres <= rounded_place * size ? 0 : apart / claim.scale};
}

}  // namespace

JudgedClaim judge_claim(const std::string& reference, const pbd::reference::StepClaim& claim,
                        const pbd::reference::IntegratorMap* map) {
  if (std::any_of(claim.contacts.begin(), claim.contacts.end(),
                  [](const auto& contact) { return contact.met && !contact.force.isZero(0); })) {
    Judged unknown;
    unknown.status = "not_judged";
    unknown.reason = not_judged_if_met;
    return {unknown, {}, {}};
  }
  JudgedClaim judged{judge_step(reference, claim.scene, claim.start, claim.h, claim.friction, map), {}, {}};
  judged.own = judged.nearest = distance(claim, judged.reference);
  for (const auto& [kept, start] :
       {std::pair{false, JudgeStart::claim}, {true, JudgeStart::claim_and_features_kept}}) {
    if (judged.nearest.of_scale <= claim.tolerance || !knows_contact(reference)) break;
    const Judged near = judge_near(reference, claim, kept, map);
    if (!kept) judged.residual = near.claim_residual;
    const StepDistance other = distance(claim, near);
    if (std::isnan(other.of_scale) || other.of_scale >= judged.nearest.of_scale / 2) continue;
    judged.nearest = other;
    judged.start = start;
  }
  if (!keeps_fixed_velocities(claim))
    judged.own.of_scale = judged.nearest.of_scale = judged.residual = pbd::infinity;
  return judged;
}

StepJudge::StepJudge(const std::filesystem::path& directory, std::string reference, std::int64_t every,
                     const pbd::Method& method)
    : reference_(std::move(reference)),
      every_(every),
      memory_(method),
      table_(directory / "judged.csv",
             {"step", "time_s", "step_s", "solver_status", "tolerance", "error", "error_m", "error_of_scale",
              "nearest_start", "nearest_error_m", "nearest_error_of_scale", "reference", "status", "reason",
              "reference_residual", "reference_iterations", "wall_s", "claim_residual"},
             &totals_) {}

void StepJudge::add(std::int64_t step, const pbd::reference::StepClaim& claim, const pbd::Report& report) {
  const auto map = memory_.map_of(claim);
  const JudgedClaim judged = judge_claim(reference_, claim, map ? &*map : nullptr);
  const double nearest = judged.nearest.of_scale;
  ++judged_;
  unsolved_ += std::isnan(nearest);
  if (report.status != pbd::Status::ok) {
    ++missed_;
  } else if (judged.solves_as_it_is()) {
    ++as_they_are_;
  } else if (!std::isnan(nearest)) {
    const bool by_itself = judged.reference.status == "ok";
    ++compared_;
    from_claim_alone_ += !by_itself;
    ambiguous_ += by_itself && judged.start == JudgeStart::claim;
    by_features_ += by_itself && judged.start == JudgeStart::claim_and_features_kept;
    if (!(worst_error_of_scale_ >= nearest)) worst_error_of_scale_ = nearest, worst_step_ = step;
    if (const double metres = judged.nearest.metres; !std::isnan(metres) && !(worst_error_m_ >= metres))
      worst_error_m_ = metres;
  }
  const Judged& own = judged.reference;
  table_.row({step, claim.start.time, claim.h,
              std::string(pbd::status_names[static_cast<std::size_t>(report.status)]), claim.tolerance,
              judged.own.relative, judged.own.metres, judged.own.of_scale,
              std::string(judge_start_names[static_cast<std::size_t>(judged.start)]), judged.nearest.metres,
              nearest, reference_, own.status, own.reason, own.residual, std::int64_t{own.iterations},
              own.seconds, judged.residual});
}

std::string StepJudge::text() const {
  std::string text = fmt::format("judged: {} steps by {}", judged_, reference_);
  if (unsolved_ > 0) text += fmt::format(", which did not solve, or does not know, {} of them", unsolved_);
  if (missed_ > 0) text += fmt::format("; {} missed their tolerance", missed_);
  if (as_they_are_ > 0)
    text += fmt::format("; by its equations, to {:g}, {} {} next to none that it finds",
                        pbd::reference::allowed_residual, as_they_are_,
                        as_they_are_ > 1 ? "are solutions" : "is a solution");
  if (compared_ > 0)
    text += fmt::format(
        "; {} end within {:.3g} m of a solution, and within {:.3g} of the scale that the tolerance refers to "
        "(step {})",
        compared_ < judged_ ? "the others" : "they", worst_error_m_, worst_error_of_scale_, worst_step_);
  if (from_claim_alone_ > 0)
    text += fmt::format("; {} of them the reference solved from what is claimed alone", from_claim_alone_);
  if (ambiguous_ > 0) text += fmt::format("; {} at another one than the reference by itself", ambiguous_);
  if (by_features_ > 0) text += fmt::format("; {} by the features where they begin alone", by_features_);
  return text;
}

}  // namespace pbdcheck
