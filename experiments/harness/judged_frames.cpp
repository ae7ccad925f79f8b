#include "harness/judged_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/files.h"
#include "harness/interrupt.h"
#include "harness/step_checks.h"
#include "harness/step_judge.h"
#include "scenes/scene_file.h"

namespace pbdcheck {

std::string SampledSteps::quantity() const {
  std::string text =
      fmt::format("distance over the step's scale, of {} of {} sampled steps", compared(), sampled);
  if (compared() > 0) text += fmt::format(" ({})", nearest.owner());
  if (missed > 0) text += fmt::format("; {} missed their tolerance", missed);
  if (unknown > 0) text += fmt::format("; {} the judge does not know", unknown);
  if (as_they_are > 0)
    text += fmt::format("; by the judge's equations, to {:g}, {} {} next to none that it finds",
                        pbd::reference::allowed_residual, as_they_are,
                        as_they_are > 1 ? "are solutions" : "is a solution");
  return text;
}

JudgedFrames::JudgedFrames(Context& context, std::string_view table)
    : context_(context),
      table_(
          context.table(table, {"scene", "nodes", "step_s", "step", "time_s", "tolerance", "status", "reason",
                                "error", "error_of_scale", "nearest_start", "nearest_error_m",
                                "nearest_error_of_scale", "reference", "reference_status", "reference_reason",
                                "reference_residual", "reference_wall_s", "claim_residual"})) {}

void JudgedFrames::run(const JudgedScene& each, double tolerance, SampledSteps& of_all) {
  constexpr std::int64_t more = 5;
  const std::int64_t every = context_.full() ? std::max<std::int64_t>(1, each.every / more) : each.every;
  const double duration = (context_.full() ? 2 : 1) * each.duration;
  std::vector<std::string> settings = each.settings;
  settings.push_back(fmt::format("method.tolerance={}", tolerance));
  const SceneFile file = read_scene_file(scenes_folder() / fmt::format("{}.toml", each.name), settings);
  const std::string reference = default_reference(file.scene);
  pbd::Workspace workspace = file.workspace();
  pbd::State state = file.scene.initial;
  const auto steps = std::min(file.steps, static_cast<std::int64_t>(std::lround(duration / file.step_s)));
  for (std::int64_t k = 1; k <= steps; ++k) {
    throw_if_interrupted();
    const pbd::State begun = state;
    const pbd::Report report = pbd::step(workspace, file.step_s, state);
    if (report.status == pbd::Status::diverged) {
      ++of_all.sampled, ++of_all.missed;
      break;
    }
    if (k % every != 0) continue;
    const JudgedClaim judged =
        judge_claim(reference, claim_of(file.scene, workspace, begun, state, file.step_s, report));
    ++of_all.sampled;
    if (report.status != pbd::Status::ok)
      ++of_all.missed;
    else if (judged.reference.status == "not_judged")
      ++of_all.unknown;
    else if (judged.solves_as_it_is())
      ++of_all.as_they_are;
    else
      of_all.nearest.add(judged.nearest.of_scale, fmt::format("{}, step {}", each.name, k));
    table_.row({std::string(each.name), std::int64_t{file.scene.nodes()}, file.step_s, k, begun.time,
                tolerance, std::string(pbd::status_names[static_cast<std::size_t>(report.status)]),
                std::string(report.reason), judged.own.relative, judged.own.of_scale,
                std::string(judge_start_names[static_cast<std::size_t>(judged.start)]), judged.nearest.metres,
                judged.nearest.of_scale, reference, judged.reference.status, judged.reference.reason,
                judged.reference.residual, judged.reference.seconds, judged.residual});
  }
  context_.advance(fmt::format("{} to {:g}", each.name, tolerance));
}

}  // namespace pbdcheck
