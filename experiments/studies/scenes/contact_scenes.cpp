// The scene files with contact, and mechanisms, each by its own method, step and duration: does what must
// hold of hard cases hold of them?
#include <array>

#include "studies/experiments.h"
#include "studies/scenes/scene_run.h"

namespace pbdcheck {
namespace {

/// Files of experiments/scenes that are in no other experiment as a whole; nothing does work on them, and
/// none begins with an overlap that parts.
constexpr std::array<std::string_view, 16> scene_names{"incline",
                                                       "stack",
                                                       "dominoes",
                                                       "boxes_at_edges",
                                                       "house_of_cards",
                                                       "cloth_on_ball",
                                                       "trampoline",
                                                       "ball_at_cloth",
                                                       "box_on_soft_block",
                                                       "soft_cubes",
                                                       "soft_balls",
                                                       "soft_block_on_box_on_cloth",
                                                       "strip_over_cylinder",
                                                       "ragdoll",
                                                       "mass_on_bar",
                                                       "boxes_1000"};
/// Those that something does work on: a pull, a belt, a hook that is led.
constexpr std::array<std::string_view, 3> driven_names{"capstan", "conveyor", "cable_arm"};
constexpr double quick_pile = 0.5;  // s, until the lowest boxes strike the ground and those above strike them

}  // namespace

void contact_scenes(Context& context) {
  std::vector<ScenePlan> plans;
  for (const std::string_view name : scene_names) {
    plans.push_back(plan_of(name));
    if (name == "boxes_1000" && !context.full()) plans.back().duration = quick_pile;
  }
  for (const std::string_view name : driven_names) {
    plans.push_back(plan_of(name));
    plans.back().driven = true;
  }
  if (context.full()) add_shorter(plans, 2);
  SceneStudy study(context, plans);
  for (const ScenePlan& plan : plans) study.run(plan, nullptr);
  study.conclude("contact_scenes", "the scenes");
  // What tilts over an edge is pushed along the arc, and gains the curvature's work: of first order in the
  // step, and as much as reference/step_energy.h allows.
  const std::string quantity = owned("largest excess over m g L", study.excess());
  context.verdict(Basis::robustness, "contact_scenes.energy",
                  "energy of what nothing drives stays below a hundredth above the start's", quantity,
                  study.excess().value(), 1e-2);
  context.verdict(Basis::goal, "contact_scenes.energy_gain",
                  "energy of what nothing drives never rises above the start's", quantity,
                  study.excess().value(), 1e-6);
}

}  // namespace pbdcheck
