// The three scenes of the paper's first figure by one solver and one default method: what they cost, and what
// stays true of them while they fall, strike and come to rest.
#include <array>

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
}

}  // namespace pbdcheck
