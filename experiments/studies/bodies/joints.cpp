// How accurately do joints carry mechanisms? Benchmarks of the IFToMM library with known answers: the error
// at the end, and the largest error of a joint in any step, over steps halved again and again; and what a
// chain of bodies costs over its length.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include "harness/integrator_rules.h"
#include "harness/measure.h"
#include "harness/probes.h"
#include "scenes/mechanisms.h"
#include "studies/bodies/joints.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;

struct Level {
  double h = 0;  // s
  Values values{};
  double error_m = 0, error_rad = 0;  // of a joint, the largest of any step
  double wall = 0;                    // s
  int missed = 0;                     // steps that missed the tolerance
  Simulation run{};
};

Level level_of(const Mechanism& mechanism, const Rule& rule, int steps) {
  Level level{.h = mechanism.duration / steps};
  const auto start = std::chrono::steady_clock::now();
  level.run = simulate_steps(mechanism.scene, rule.method, level.h, steps,
                             [&](const State&, const State& after) -> std::string_view {
                               for (const Effect& effect : mechanism.scene.effects) {
                                 double& error =
                                     error_unit(effect) == "_rad" ? level.error_rad : level.error_m;
                                 error = larger(error, constraint_error(mechanism.scene, effect, after));
                               }
                               return larger(level.error_m, level.error_rad) < 1 ? "" : "a joint came apart";
                             });
  level.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  level.missed = level.run.steps - level.run.steps_ok;
  level.values = mechanism.values(level.run.end);
  return level;
}

/// What rounding leaves of a step's residual where joints' rows depend on each other: places are known to
/// eps L, rates of constraints to eps L/h, of a change of velocity g h.
double rounding_of(const Mechanism& mechanism, double h) {
  constexpr double g = 9.81;  // m/s^2
  return std::numeric_limits<double>::epsilon() * mechanism.farthest / (g * h * h);
}

bool all_solved(const Mechanism& mechanism, const Level& level) {
  return level.run.status != Status::diverged && level.run.missed_residual <= rounding_of(mechanism, level.h);
}

/// Largest difference relative to the mechanism's size; angles modulo 2 pi for the squeezer.
double distance(const Mechanism& mechanism, const Values& a, const Values& b) {
  Worst largest;
  const bool angles = mechanism.values == squeezer_angles;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest.add(std::abs(angles ? std::remainder(a[i] - b[i], 2 * std::numbers::pi) : a[i] - b[i]) /
                mechanism.size);
  return largest.value();
}

/// Richardson's extrapolation of the two finest levels, errors of the second order.
Values extrapolated(const Level& coarse, const Level& fine) {
  Values limit;
  for (std::size_t i = 0; i < fine.values.size(); ++i)
    limit.push_back(fine.values[i] +
                    std::remainder(fine.values[i] - coarse.values[i], 2 * std::numbers::pi) / 3);
  return limit;
}

/// Of `generalised_alpha`. Nothing is concluded from steps that were not solved.
void conclude(Context& context, const Mechanism& mechanism, const std::vector<Level>& levels) {
  const std::string id = "joints." + mechanism.name;
  const Level &coarse = levels[levels.size() - 2], &finest = levels.back();
  const auto error_of = [&](const Values& values, bool trusted) {
    return trusted ? distance(mechanism, values, mechanism.expected) : std::nan("");
  };
  context.verdict(Basis::theory, id + ".solved",
                  "what a step of the finest run misses its tolerance by is rounding, eps L/(g h^2)",
                  "largest residual of a missed step",
                  finest.run.status == Status::diverged ? std::nan("") : finest.run.missed_residual,
                  rounding_of(mechanism, finest.h));
  const bool exact = mechanism.values == slider_place;  // a motor's place does not depend on the step
  if (context.full() || exact)
    context.verdict(Basis::code, id, "generalised_alpha reaches the known answer by refining the step",
                    "relative error at the finest step",
                    error_of(finest.values, all_solved(mechanism, finest)), 1e-6);
  if (!exact)
    context.verdict(Basis::code, id + ".extrapolated", "the two finest steps extrapolate to the known answer",
                    "relative error",
                    error_of(extrapolated(coarse, finest),
                             all_solved(mechanism, coarse) && all_solved(mechanism, finest)),
                    1e-6);
}

void carry(Context& context, const Mechanism& mechanism, Table& accuracy, Worst& error_m, Worst& error_rad) {
  for (const Rule& rule : integrator_rules({0.55})) {
    if (rule.marginal || rule.method.integrator == "symplectic_euler") continue;
    std::vector<Level> levels(static_cast<std::size_t>(mechanism.levels));
    context.parallel(mechanism.levels, [&](std::int64_t k) {
      levels[static_cast<std::size_t>(k)] = level_of(mechanism, rule, mechanism.coarsest_steps << k);
    });
    double coarser = std::nan("");
    for (const Level& level : levels) {
      const double error = distance(mechanism, level.values, mechanism.expected);
      std::vector<Cell> row{mechanism.name};
      for (auto& cell : method_cells(rule)) row.push_back(std::move(cell));
      row.insert(row.end(),
                 {level.h, error, std::log2(coarser / error), std::max(level.error_m, level.error_rad),
                  std::int64_t{level.missed}, level.wall, status_cell(level.run.status), level.run.reason});
      accuracy.row(row);
      coarser = error;
      error_m.add(level.error_m);
      error_rad.add(level.error_rad);
    }
    if (rule.method.integrator == "generalised_alpha") conclude(context, mechanism, levels);
  }
}

}  // namespace

/// A step of each mechanism on its way, and of a top.
std::vector<Case> joints_cases(bool) {
  constexpr int lead_steps = 20;
  std::vector<Case> all;
  for (const auto& mechanism : known_mechanisms(false)) {
    const double h = mechanism.duration / mechanism.coarsest_steps;
    all.push_back({mechanism.name, mechanism.scene, h, h, lead_steps});
  }
  all.push_back({"heavy top", heavy_top(0.5, 100, 2), 1e-3, 1e-3, lead_steps});
  all.push_back({"heavy top on a spring", heavy_top(0.5, 100, 2, 1e-4), 1e-3, 1e-3, lead_steps});
  return all;
}

void joints(Context& context) {
  const auto all = known_mechanisms(context.full());
  context.begin(std::ssize(all) + 1);
  Table accuracy =
      context.table("accuracy", {"mechanism", "integrator", "alpha", "outer", "relaxation", "step_s", "error",
                                 "order", "joint_error", "missed_steps", "wall_s", "status", "reason"});
  Worst error_m, error_rad;
  for (const Mechanism& mechanism : all) {
    carry(context, mechanism, accuracy, error_m, error_rad);
    context.advance(mechanism.name);
  }
  accuracy.close();
  context.verdict(Basis::theory, "joints.error_m", "joints hold in each step", "largest error of a length, m",
                  error_m.value(), 1e-10);
  context.verdict(Basis::theory, "joints.error_rad", "joints hold in each step",
                  "largest error of an angle, rad", error_rad.value(), 1e-10);
  joint_lengths(context);
  context.advance("chains of 50 to 3200 bodies");
}

}  // namespace pbdcheck
