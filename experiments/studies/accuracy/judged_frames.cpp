// Steps of whole scenes against a judge that solves them anew: bodies, cloth and solids with damping, contact
// and friction in one system. What is asked of the solver at a tolerance is asked at three, so that the
// distance can be seen to follow it, or not to.
#include <fmt/format.h>

#include <cmath>

#include "harness/files.h"
#include "harness/measure.h"
#include "harness/step_checks.h"
#include "harness/step_judge.h"
#include "scenes/contacts.h"
#include "scenes/scene_file.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;

/// A scene, how long it is simulated (s), and each how many steps one is judged.
struct JudgedScene {
  std::string_view name;
  double duration;
  std::int64_t every;
};
constexpr std::array<JudgedScene, 7> judged_scenes{{{"incline", 0.2, 10},
                                                    {"boxes_at_edges", 0.15, 1},
                                                    {"dominoes", 0.6, 20},
                                                    {"trampoline", 0.5, 10},
                                                    {"box_on_soft_block", 0.6, 10},
                                                    {"soft_cubes", 0.5, 10},
                                                    {"flexible_cow", 0.6, 12}}};
constexpr std::array<double, 3> tolerances{1e-4, 1e-6, 1e-8};
constexpr std::int64_t longer = 5;  // times as many steps are judged, over twice the time

/// Of the steps that say ok at one tolerance.
struct Agreement {
  Worst nearest;
  std::int64_t judged = 0;
};

void run_scene(const JudgedScene& each, double tolerance, Table& frames, Agreement& of_all,
               Context& context) {
  const std::int64_t every = context.full() ? std::max<std::int64_t>(1, each.every / longer) : each.every;
  std::vector<std::string> settings{fmt::format("method.tolerance={}", tolerance)};
  // The reference takes minutes a frame with all of its surface.
  if (each.name == "flexible_cow") settings.emplace_back("solid.0.contact={ radius_m = 0 }");
  SceneFile file = read_scene_file(scenes_folder() / fmt::format("{}.toml", each.name), settings);
  const std::string reference = default_reference(file.scene);
  Workspace workspace = file.workspace();
  State state = file.scene.initial;
  const double duration = (context.full() ? 2 : 1) * each.duration;
  const auto steps = std::min(file.steps, static_cast<std::int64_t>(std::lround(duration / file.step_s)));
  for (std::int64_t k = 1; k <= steps; ++k) {
    throw_if_interrupted();
    const State begun = state;
    const Report report = step(workspace, file.step_s, state);
    if (report.status == Status::diverged) break;
    if (k % every != 0) continue;
    const auto claim = claim_of(file.scene, workspace, begun, state, file.step_s, report);
    const JudgedClaim judged = judge_claim(reference, claim);
    if (report.status == Status::ok) {
      ++of_all.judged;
      of_all.nearest.add(judged.nearest.of_scale, fmt::format("{}, step {}", each.name, k));
    }
    frames.row({std::string(each.name), file.step_s, k, begun.time, tolerance,
                std::string(status_names[static_cast<std::size_t>(report.status)]),
                std::string(report.reason), judged.own.relative, judged.own.of_scale,
                std::string(judge_start_names[static_cast<std::size_t>(judged.start)]), judged.nearest.metres,
                judged.nearest.of_scale, reference, judged.reference.status, judged.reference.residual,
                judged.reference.seconds});
  }
  context.advance(fmt::format("{} to {:g}", each.name, tolerance));
}

}  // namespace

void judged_frames(Context& context) {
  context.begin(static_cast<std::int64_t>(judged_scenes.size() * tolerances.size()));
  Table frames =
      context.table("frames", {"scene", "step_s", "step", "time_s", "tolerance", "status", "reason", "error",
                               "error_of_scale", "nearest_start", "nearest_error_m", "nearest_error_of_scale",
                               "reference", "reference_status", "reference_residual", "reference_wall_s"});
  Agreement at_last;
  for (const double tolerance : tolerances) {
    Agreement of_all;
    for (const JudgedScene& each : judged_scenes) run_scene(each, tolerance, frames, of_all, context);
    at_last = of_all;
  }
  frames.close();
  constexpr double asked = 1e-6;
  context.verdict(
      Basis::goal, "judged_frames.nearest",
      "each step that says ok at a tolerance of 1e-8 ends within 1e-6 of a solution that the judge finds",
      fmt::format("distance over the step's scale, of {} steps ({})", at_last.judged,
                  at_last.nearest.owner()),
      at_last.nearest.value(), asked);
}

}  // namespace pbdcheck
