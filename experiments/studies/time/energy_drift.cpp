// The energy of nonlinear springs is not conserved by the symmetric rules, but its error over 10 s stays
// below C h^2: halving the step divides the largest error by 4, up to the next term. With errors D = C h^2 (1
// + e h^2) on three levels, the finer pair's departure from 4 is a quarter of the coarser pair's;
// the bound is half of it, twice that, for the terms left out, and no more than an order of 3/2 leaves.
// Errors of first order miss it: theirs are alike.
#include <algorithm>
#include <cmath>

#include "harness/integrator_rules.h"
#include "harness/measure.h"
#include "harness/probes.h"
#include "scenes/standard.h"
#include "studies/time/energy.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr double drift_duration = 10;  // s
constexpr int levels = 3;

struct DriftMotion {
  std::string name;
  Scene scene;
  double coarsest;  // s
};

Scene spring_pendulum() {
  Scene scene = pendulum(1, 0);
  std::get<Distance>(scene.effects[1]).compliance[0] = 0.01;
  return scene;
}

struct DriftLevel {
  double h;
  double drift = 0;  // largest |E - E0| over the scale
  Simulation run{};
};

struct DriftCourse {
  const DriftMotion* motion;
  Rule rule;
  std::vector<DriftLevel> level{};
};

void follow_drift(const Scene& scene, const Method& method, DriftLevel& level) {
  const double start = total_energy(scene, scene.initial), scale = energy_scale(scene);
  Worst drift;
  const int steps = static_cast<int>(std::lround(drift_duration / level.h));
  level.run = simulate_steps(scene, method, level.h, steps, [&](const State&, const State& now) {
    drift.add(std::abs(total_energy(scene, now) - start) / scale);
    return drift.value() < 10 ? "" : "energy grew by ten times its scale";
  });
  level.drift = drift.value();
}

void conclude_drift(Context& context, Table& table, const DriftCourse& course) {
  bool ok = true;
  std::vector<double> ratio;  // of the coarser level's drift over this one's
  double coarser = std::nan("");
  for (const auto& [h, drift, run] : course.level) {
    ratio.push_back(coarser / drift);
    std::vector<Cell> row{course.motion->name};
    for (auto& cell : method_cells(course.rule)) row.push_back(std::move(cell));
    row.insert(row.end(), {h, drift, ratio.back(), status_cell(run.status), run.reason});
    table.row(row);
    ok = ok && run.status == Status::ok;
    coarser = drift;
  }
  const double nearer_to_two = 4 / std::pow(2, 1.5) - 1;  // than to one, of orders
  context.verdict(
      Basis::theory, "energy.drift." + course.motion->name + "." + course.rule.method.integrator,
      "halving the step divides the largest error of the energy over 10 s by 4, up to the next order",
      "|4 / ratio of the finer pair - 1|", ok ? std::abs(4 / ratio[2] - 1) : std::nan(""),
      std::min(std::abs(4 / ratio[1] - 1) / 2, nearer_to_two));
}

}  // namespace

void energy_drift(Context& context) {
  const std::vector<DriftMotion> motions{{"spring_pendulum", spring_pendulum(), 1.0 / 60},
                                         {"free_beam", free_beam(context.full() ? 4 : 2, 1e4), 1.0 / 240}};
  std::vector<DriftCourse> courses;
  for (const DriftMotion& motion : motions)
    for (const Rule& rule : integrator_rules({0.5})) {
      const auto& name = rule.method.integrator;
      if (name != "newmark" && name != "midpoint") continue;
      courses.push_back({&motion, rule});
      for (int k = 0; k < levels; ++k) courses.back().level.push_back({motion.coarsest / (1 << k)});
    }
  context.parallel(std::ssize(courses) * levels, [&](std::int64_t index) {
    DriftCourse& course = courses[static_cast<std::size_t>(index / levels)];
    follow_drift(course.motion->scene, course.rule.method,
                 course.level[static_cast<std::size_t>(index % levels)]);
  });
  Table table = context.table("drift", {"scene", "integrator", "alpha", "outer", "relaxation", "step_s",
                                        "drift", "ratio", "status", "reason"});
  for (const DriftCourse& course : courses) conclude_drift(context, table, course);
  table.close();
  context.advance("drift");
}

}  // namespace pbdcheck
