// Energy and momentum over time, by every integrator, with hard and with compliant constraints.
#include <cmath>
#include <numbers>

#include "harness/integrator_rules.h"
#include "harness/measure.h"
#include "harness/probes.h"
#include "scenes/standard.h"
#include "studies/time/energy.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr double series_duration = 10;                // s
constexpr double oscillation = 4 * std::numbers::pi;  // rad/s

struct SeriesMotion {
  std::string name;
  Scene scene;
};

/// 1 kg on a link along x of rest length 1 m, 0.1 m beyond it.
Scene series_spring() {
  Scene scene;
  add_node(scene, Vec3::Zero(), infinity);
  add_node(scene, Vec3(1.1, 0, 0), 1);
  scene.effects.emplace_back(
      Distance{.node = {{0, 1}}, .rest_length = {1}, .compliance = {1 / (oscillation * oscillation)}});
  return scene;
}

Scene pendulum_on_spring(double stiffness) {
  Scene scene = pendulum(std::numbers::pi / 2, 0);
  std::get<Distance>(scene.effects[1]).compliance[0] = 1 / stiffness;
  return scene;
}

std::vector<SeriesMotion> series_motions() {
  return {{"spring", series_spring()},
          {"hard pendulum", pendulum_on_spring(infinity)},
          {"pendulum, 1e4 N/m", pendulum_on_spring(1e4)},
          {"spring pendulum, 100 N/m", pendulum_on_spring(100)},
          {"cloth", cloth(4)},
          {"free beam", free_beam(4, 1e5)}};
}

struct Sample {
  double time, energy, momentum, angular_momentum;
};

struct Series {
  const SeriesMotion* motion;
  Rule rule;
  double h;
  std::vector<Sample> samples{};
  double largest_change = 0;  // of the energy, relative to that of the start
  Simulation run{};
};

Sample sample(const Scene& scene, const State& state) {
  return {state.time, total_energy(scene, state), linear_momentum(scene, state).norm(),
          angular_momentum(scene, state).norm()};
}

void follow(Series& series) {
  const Scene& scene = series.motion->scene;
  const double start = total_energy(scene, scene.initial), scale = energy_scale(scene);
  const int steps = static_cast<int>(std::lround(series_duration / series.h)), every = steps / 150;
  series.samples.push_back(sample(scene, scene.initial));
  Worst change;
  int done = 0;
  series.run =
      simulate_steps(scene, series.rule.method, series.h, steps, [&](const State&, const State& now) {
        const double energy = total_energy(scene, now);
        change.add(std::abs(energy - start) / std::abs(start));
        const bool lost = !(energy - start < 10 * scale);
        if (++done % every == 0 || lost) series.samples.push_back(sample(scene, now));
        return lost ? "energy grew by ten times its scale" : "";
      });
  series.largest_change = change.value();
}

void write_series(Table& table, const Series& series) {
  for (const auto& [time, energy, momentum, angular] : series.samples) {
    std::vector<Cell> row{series.motion->name};
    for (auto& cell : method_cells(series.rule)) row.push_back(std::move(cell));
    row.insert(row.end(), {series.h, time, energy, energy_scale(series.motion->scene), momentum, angular,
                           status_cell(series.run.status), series.run.reason});
    table.row(row);
  }
}

void linear_verdicts(Context& context, const Series& series) {
  const bool ok = series.run.status == Status::ok;
  if (series.rule.name() == "newmark 0.5")
    context.verdict(Basis::theory, "energy.spring.newmark",
                    "newmark with alpha 1/2 keeps a linear spring's energy over 10 s", "largest |E - E0|/E0",
                    ok ? series.largest_change : std::nan(""), 1e-10);
  if (series.rule.name() != "implicit_euler") return;
  const double wh = oscillation * series.h;
  const double left = std::pow(1 + wh * wh, -series.run.steps);
  const double found = series.samples.back().energy / series.samples.front().energy;
  context.verdict(Basis::theory, "energy.spring.implicit_euler",
                  "implicit Euler leaves (1 + (w h)^2)^-N of a linear spring's energy after N steps",
                  "|measured/formula - 1|", ok ? std::abs(found / left - 1) : std::nan(""), 1e-8);
}

}  // namespace

void energy_series(Context& context) {
  const auto scenes = series_motions();
  std::vector<Series> all;
  for (const SeriesMotion& motion : scenes)
    for (const double h : context.full() ? std::vector{1.0 / 60, 1.0 / 240} : std::vector{1.0 / 60})
      for (const Rule& rule : integrator_rules({1, 0.6, 0.55, 0.52, 0.5})) all.push_back({&motion, rule, h});
  context.parallel(std::ssize(all),
                   [&](std::int64_t index) { follow(all[static_cast<std::size_t>(index)]); });
  Table table = context.table(
      "series", {"scene", "integrator", "alpha", "outer", "relaxation", "step_s", "time_s", "energy_j",
                 "scale_j", "momentum_kg_m_s", "angular_momentum_kg_m2_s", "status", "reason"});
  for (const Series& series : all) {
    write_series(table, series);
    if (series.motion->name == "spring" && series.h == 1.0 / 60) linear_verdicts(context, series);
  }
  table.close();
  context.advance("series");
}

}  // namespace pbdcheck
