// The three scenes of the paper's first figure by one solver and one default method: what they cost, and what
// stays true of them while they fall, strike and come to rest. Sampled steps of small versions, solved to
// 1e-10, are judged: whole ones take the judge too long.
#include <array>

#include "harness/judged_frames.h"
#include "harness/step_judge.h"
#include "studies/experiments.h"
#include "studies/scenes/scene_run.h"

namespace pbdcheck {
namespace {

struct PaperScene {
  std::string_view name;
  double quick_duration;  // s, until all have come down
};
constexpr std::array<PaperScene, 3> paper_scenes{
    {{"boxes_on_ground", 2}, {"bunnies_on_cloth", 1}, {"flexible_cow", 2}}};

void judge_small_versions(Context& context) {
  const std::string direct = "method.relaxation=direct";
  const std::vector<JudgedScene> small{
      {"boxes_on_ground", 0.8, 6, {direct, "rigid_body.1.copies=[2, 2, 2]"}},
      {"bunnies_on_cloth", 0.6, 6, {direct, "rigid_body.1.copies=[1, 1, 1]", "cloth.0.cells=[10, 10]"}},
      {"flexible_cow", 0.6, 18, {direct, std::string(cow_of_nodes)}}};
  context.begin(std::ssize(small));
  JudgedFrames frames(context, "frames");
  SampledSteps sampled;
  for (const JudgedScene& each : small) frames.run(each, 1e-10, sampled);
  frames.close();
  context.verdict(
      Basis::goal, "figure_1.judged",
      "each sampled step of the small versions that says ok and that the judge knows ends within 1e-6 of a "
      "solution that it finds, or is a solution by its equations",
      sampled.quantity(), sampled.nearest.value(), next_to_solution);
}

}  // namespace

void figure_1(Context& context) {
  std::vector<ScenePlan> plans;
  for (const PaperScene& scene : paper_scenes) {
    plans.push_back(plan_of(scene.name));
    if (!context.full()) plans.back().duration = scene.quick_duration;
  }
  if (context.full()) add_shorter(plans, 4);
  SceneStudy study(context, plans);
  Table series = context.table("series", series_columns());
  for (const ScenePlan& plan : plans) study.run(plan, &series);
  series.close();
  study.conclude("figure_1", "the paper's three scenes");
  context.verdict(Basis::robustness, "figure_1.energy",
                  "energy never rises above the start's: nothing does work on the scenes",
                  owned("largest excess over m g L", study.excess()), study.excess().value(), 1e-6);
  if (context.full())
    context.verdict(Basis::goal, "figure_1.rest", "after 10 s the scenes are at rest",
                    owned("kinetic energy over m g and a body's least size", study.rest()),
                    study.rest().value(), 1e-6);
  judge_small_versions(context);
}

}  // namespace pbdcheck
