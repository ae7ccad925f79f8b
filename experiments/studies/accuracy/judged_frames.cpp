// Steps of whole scenes against a judge that solves them anew: bodies, cloth and solids with damping, contact
// and friction in one system. What is asked of the solver at a tolerance is asked at three, so that the
// distance can be seen to follow it, or not to.
#include "harness/judged_frames.h"

#include <array>

#include "harness/step_judge.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

constexpr std::array<double, 3> tolerances{1e-4, 1e-6, 1e-8};

}  // namespace

void judged_frames(Context& context) {
  const std::vector<JudgedScene> scenes{{"incline", 0.2, 10},
                                        {"boxes_at_edges", 0.15, 1},
                                        {"dominoes", 0.6, 20},
                                        {"trampoline", 0.5, 10},
                                        {"box_on_soft_block", 0.6, 10},
                                        {"soft_cubes", 0.5, 10},
                                        {"flexible_cow", 0.6, 12, {std::string(cow_of_nodes)}}};
  context.begin(static_cast<std::int64_t>(scenes.size() * tolerances.size()));
  JudgedFrames frames(context, "frames");
  SampledSteps at_last;
  for (const double tolerance : tolerances) {
    at_last = {};
    for (const JudgedScene& each : scenes) frames.run(each, tolerance, at_last);
  }
  frames.close();
  context.verdict(Basis::goal, "judged_frames.nearest",
                  "each step that says ok at a tolerance of 1e-8 ends within 1e-6 of a solution that the "
                  "judge finds, or is "
                  "a solution by its equations",
                  at_last.quantity(), at_last.nearest.value(), next_to_solution);
}

}  // namespace pbdcheck
