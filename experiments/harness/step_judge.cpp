#include "harness/step_judge.h"

#include <fmt/format.h>

#include <cmath>

#include "harness/judges.h"
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

/// How far a step ended from a reference's end.
struct Distance {
  double relative = std::nan(""), metres = std::nan(""), of_scale = std::nan("");
};

Distance distance(const pbd::reference::StepClaim& claim, const Judged& judged) {
  if (judged.status != "ok") return {};
  const pbd::Points reached = places(claim.scene, claim.end.x, claim.end.orientation),
                    begin = places(claim.scene, claim.start.x, claim.start.orientation);
  const double apart = velocity_distance(claim.scene, claim.end, judged.end);
  return {relative_error(reached, judged.x, begin), relative_error(reached, judged.x, judged.x),
          apart == 0 ? 0 : apart / claim.scale};
}

/// What a reference says of a claim, by the start from which it ends nearest to it.
struct Agreement {
  Distance off;
  std::string_view start = "own";
};

Agreement nearest_of(const std::string& reference, const pbd::reference::StepClaim& claim,
                     const Distance& own) {
  Agreement best{own};
  const bool knows_contact = reference != pbd::reference::judges()[0].name;
  for (const auto& [kept, start] : {std::pair{false, "claim"}, {true, "claim and features kept"}}) {
    if (best.off.of_scale <= claim.tolerance || !knows_contact) break;
    const Distance other = distance(claim, judge_near(reference, claim, kept));
    if (!std::isnan(other.of_scale) && !(other.of_scale >= best.off.of_scale / 2)) best = {other, start};
  }
  return best;
}

}  // namespace

StepJudge::StepJudge(const std::filesystem::path& directory, std::string reference, std::int64_t every)
    : reference_(std::move(reference)),
      every_(every),
      table_(directory / "judged.csv",
             {"step", "time_s", "step_s", "solver_status", "tolerance", "error", "error_m", "error_of_scale",
              "nearest_start", "nearest_error_m", "nearest_error_of_scale", "reference", "status", "reason",
              "reference_residual", "reference_iterations", "wall_s"},
             &totals_) {}

void StepJudge::add(std::int64_t step, const pbd::reference::StepClaim& claim, const pbd::Report& report) {
  const Judged judged = judge_step(reference_, claim.scene, claim.start, claim.h, claim.friction);
  const Distance own = distance(claim, judged);
  Agreement nearest{own};
  ++judged_;
  if (report.status == pbd::Status::ok) {
    nearest = nearest_of(reference_, claim, own);
    ambiguous_ += nearest.start == "claim";
    by_features_ += nearest.start == "claim and features kept";
    if (!std::isnan(nearest.off.of_scale)) {
      if (!(nearest.off.of_scale <= worst_error_of_scale_)) worst_step_ = step;
      worst_error_of_scale_ = pbd::larger(worst_error_of_scale_, nearest.off.of_scale);
      worst_error_m_ = pbd::larger(worst_error_m_, nearest.off.metres);
    }
  } else {
    ++missed_;
  }
  unsolved_ += std::isnan(nearest.off.of_scale);
  table_.row({step, claim.start.time, claim.h,
              std::string(pbd::status_names[static_cast<std::size_t>(report.status)]), claim.tolerance,
              own.relative, own.metres, own.of_scale, std::string(nearest.start), nearest.off.metres,
              nearest.off.of_scale, reference_, judged.status, judged.reason, judged.residual,
              std::int64_t{judged.iterations}, judged.seconds});
}

std::string StepJudge::text() const {
  std::string text = fmt::format("judged: {} steps by {}", judged_, reference_);
  if (unsolved_ > 0) text += fmt::format(", which did not solve {} of them", unsolved_);
  if (missed_ > 0) text += fmt::format("; {} missed their tolerance", missed_);
  if (judged_ > unsolved_ + missed_)
    text += fmt::format(
        "; the others end within {:.3g} m of a solution, {:.3g} of the scale that the tolerance "
        "refers to (step {})",
        worst_error_m_, worst_error_of_scale_, worst_step_);
  if (ambiguous_ > 0) text += fmt::format("; {} at another one than the reference by itself", ambiguous_);
  if (by_features_ > 0) text += fmt::format("; {} by the features where they begin alone", by_features_);
  return text;
}

}  // namespace pbdcheck
