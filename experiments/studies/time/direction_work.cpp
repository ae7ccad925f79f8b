// Violations of constraints by linearisations of one step, and by as many row updates of shorter steps.
#include <cmath>

#include "harness/measure.h"
#include "studies/time/direction.h"

namespace pbdcheck {
namespace {

using namespace pbd;

struct Budget {
  const DirectionScene* scene;
  const Scheme* scheme;
  int linearisations;  // a frame
  double h;            // s
  DirectionRun run{};
};

/// Position schemes linearise one step so often, velocity schemes do as many steps.
std::vector<Budget> budgets(const std::vector<DirectionScene>& scenes, const std::vector<Scheme>& schemes,
                            bool full) {
  const std::vector<int> counts =
      full ? std::vector{1, 2, 4, 8, 16, 32, 64, 128} : std::vector{1, 2, 4, 8, 16, 32, 64};
  std::vector<Budget> all;
  for (const auto& scene : scenes)
    for (const auto& scheme : schemes)
      for (const int count : counts)
        all.push_back({&scene, &scheme, count,
                       scheme.family == "velocity" ? direction_frame / count : direction_frame});
  return all;
}

void write(Context& context, const std::vector<Budget>& all, double duration) {
  Table table =
      direction_table(context, "equal_work",
                      {"linearisations_per_frame", "step_s", "duration_s", "row_updates_per_s", "error",
                       "violation_rms", "energy_change", "missed_steps", "steps", "status", "reason"});
  for (const auto& each : all)
    add_row(table, each.scene->name, *each.scheme,
            {std::int64_t{each.linearisations}, each.h, duration, each.run.work_per_s,
             each.run.violation_largest, each.run.violation_rms, each.run.energy_end,
             std::int64_t{each.run.missed}, std::int64_t{each.run.steps}},
            each.run);
  table.close();
}

/// The violation by velocity time stepping of the same kind that does as much work or the next more.
double next_dearer(const std::vector<Budget>& all, const Budget& each, const Scheme& other) {
  const Budget* next = nullptr;
  for (const auto& run : all)
    if (run.scene == each.scene && run.scheme == &other && run.run.work_per_s >= each.run.work_per_s &&
        (!next || run.run.work_per_s < next->run.work_per_s))
      next = &run;
  return next ? next->run.violation_largest : std::nan("");
}

}  // namespace

void direction_equal_work(Context& context) {
  const double duration = context.full() ? 10 : 2;  // s
  const std::vector<DirectionScene> scenes{hard_pendulum(), taut_chain(0.1), swinging_tip(10, 1),
                                           swinging_tip(10, 100)};
  const auto tried = default_schemes();
  auto all = budgets(scenes, tried, context.full());
  context.parallel(std::ssize(all), [&](std::int64_t index) {
    Budget& each = all[index];
    Method method = each.scheme->method;
    if (each.scheme->family == "position") method.max_outer = each.linearisations;
    each.run = simulate(*each.scene, method, each.h, duration);
  });
  write(context, all, duration);
  Worst ratio;
  for (const auto& each : all)
    if (each.scene == scenes.data() && each.scheme->family == "position" &&
        each.scheme->method.direction_blend == 1)
      for (const auto& other : tried)
        if (other.family == "velocity") ratio.add(each.run.violation_largest / next_dearer(all, each, other));
  // One linearisation leaves the pendulum's link by (h v)^2/2 l. The next begins at a velocity that is off by
  // h^2 times an acceleration, and leaves by the square of that: less, as h a < v.
  context.verdict(Basis::paper, "direction.equal_work",
                  "on the pendulum, linearisations of one step violate the link less than as many row "
                  "updates of shorter steps",
                  "largest violation, position/velocity", ratio.value(), 1);
}

}  // namespace pbdcheck
