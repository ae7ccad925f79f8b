// How accurately do joints carry mechanisms? Benchmarks of the IFToMM library with known answers: the error
// at the end, and the largest error of a joint in any step, over steps halved again and again; and what a
// chain of bodies costs over its length.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>
#include <numbers>

#include "closed_form.h"
#include "experiments.h"
#include "integrator_rules.h"
#include "measure.h"
#include "numerics.h"
#include "order_fit.h"
#include "probes.h"
#include "relaxation.h"
#include "rows_of_step.h"
#include "scenes/mechanisms.h"

namespace pbdcheck {
namespace {

using namespace pbd;

using Values = std::vector<double>;

struct Mechanism {
  std::string name;
  Scene scene;
  double duration;     // s
  int coarsest_steps;  // of the first level
  int levels;
  Values expected;  // m or rad, at the end
  double size;      // what errors are relative to
  Values (*values)(const State&);
  double farthest = 0;  // m, of a place under gravity from the origin; 0: there is no gravity
};

double angle_of(const State& state, std::size_t body) {
  const auto& q = state.orientation[body];
  return 2 * std::atan2(q.z(), q.w());
}

Values bob(const State& state) {
  return {state.x(0, 1), state.x(1, 1)};
}

/// Top of the first leg.
Values first_top(const State& state) {
  const Vec3 top = Vec3(state.x.col(1)) + state.orientation[1] * Vec3(0.5, 0, 0);
  return {top.x(), top.y()};
}

/// beta, theta, gamma, phi, delta, omega, epsilon of Andrews' mechanism.
Values squeezer_angles(const State& state) {
  const auto k = [&](std::size_t body) { return angle_of(state, body); };
  return {k(1), k(2) - k(1), k(3), k(4) - k(5), k(5), k(6) - k(7), k(7)};
}

Values slider(const State& state) {
  return {state.x(0, 3)};
}

/// The chain of four-bars moves as theta'' = -(G/I) cos theta with all legs parallel.
Values four_bars_end(int loops, double duration) {
  const double inertia = (loops + 1) / 3.0 + loops, weight = ((loops + 1) / 2.0 + loops) * 9.81;
  const auto solution = reference::solve_ode(
      [&](double, const Eigen::VectorXd& y, Eigen::VectorXd& slope) {
        slope[0] = y[1];
        slope[1] = -weight / inertia * std::cos(y[0]);
      },
      Eigen::Vector2d(std::numbers::pi / 2, -1), {duration});
  const double theta = solution.states[0][0];
  return {std::cos(theta), std::sin(theta)};
}

std::vector<Mechanism> mechanisms(bool full) {
  const double swing = reference::pendulum_motion(1, 9.81, std::numbers::pi / 2, 10).angle;
  const double rate = 5, turned = rate * 2, crank = 0.2, rod = 0.5;
  // The squeezer at 0.03 s: the Test Set for IVP Solvers (Mazzia, Magherini 2008).
  const Values squeezed{15.81077119629904,  -15.75637105984298, 0.04082224013073101, -0.5347301163226948,
                        0.5244099658805304, 0.5347301163226948, 1.048080741042263};
  return {{"A01 pendulum",
           point_pendulum(),
           10,
           2000,
           full ? 8 : 5,
           {-std::sin(swing), -std::cos(swing)},
           1,
           bob,
           1},
          {"A02 four-bar chain", four_bars(2), 10, 2500, full ? 6 : 4, four_bars_end(2, 10), 1, first_top, 3},
          {"A03 squeezer", andrews_squeezer(), 0.03, 600, full ? 6 : 4, squeezed, 15.81077119629904,
           squeezer_angles},
          {"slider-crank",
           slider_crank(rate),
           2,
           400,
           2,
           {crank * std::cos(turned) + std::sqrt(rod * rod - std::pow(crank * std::sin(turned), 2))},
           crank,
           slider}};
}

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
  level.run =
      simulate_steps(mechanism.scene, rule.method, level.h, steps,
                     [&](const State&, const State& after) -> std::string_view {
                       for (const Effect& effect : mechanism.scene.effects) {
                         double& error = error_unit(effect) == "_rad" ? level.error_rad : level.error_m;
                         error = std::max(error, constraint_error(mechanism.scene, effect, after));
                       }
                       return std::max(level.error_m, level.error_rad) < 1 ? "" : "a joint came apart";
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

bool solved(const Mechanism& mechanism, const Level& level) {
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
  context.verdict(id + ".solved",
                  "what a step of the finest run misses its tolerance by is rounding, eps L/(g h^2)",
                  "largest residual of a missed step",
                  finest.run.status == Status::diverged ? std::nan("") : finest.run.missed_residual,
                  rounding_of(mechanism, finest.h));
  const bool exact = mechanism.values == slider;  // a motor's place does not depend on the step
  if (context.full() || exact)
    context.verdict(id, "generalised_alpha reaches the known answer by refining the step",
                    "relative error at the finest step", error_of(finest.values, solved(mechanism, finest)),
                    1e-6);
  if (!exact)
    context.verdict(
        id + ".extrapolated", "the two finest steps extrapolate to the known answer", "relative error",
        error_of(extrapolated(coarse, finest), solved(mechanism, coarse) && solved(mechanism, finest)), 1e-6);
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

/// Processor's seconds a step of a chain of bodies at four linearisations of one sweep each (fewer where
/// only rounding is left), and for one of these; at so small a step that the solver needs no estimate of
/// plain's contraction, whose sweeps would count.
void lengths(Context& context) {
  constexpr double h = 1e-4;  // s
  const std::vector<int> counts{50, 200, 800, 3200};
  Table table = context.table("lengths", {"relaxation", "bodies", "cpu_s_per_step", "cpu_s_per_sweep",
                                          "exponent_step", "exponent_sweep", "status", "reason"});
  for (const auto relaxation : relaxation_names()) {
    std::vector<double> size, step_time, sweep_time;
    for (const int count : counts) {
      const Scene scene = rod_chain(count);
      Method method;
      method.relaxation = relaxation;
      method.outer = "plain";
      method.tolerance = 0;
      method.max_outer = 4;
      method.max_sweeps = 1;
      double step_best = infinity, sweep_best = infinity;
      Workspace workspace(scene, method);
      for (int repeat = 0; repeat < 6; ++repeat) {
        State state = scene.initial;
        const std::clock_t start = std::clock();
        const Report report = step(scene, method, h, state, workspace);
        const double spent = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
        if (repeat == 0) continue;  // the memory is touched for the first time
        step_best = std::min(step_best, spent);
        sweep_best =
            std::min(sweep_best, spent / static_cast<double>(std::max<std::int64_t>(report.sweeps, 1)));
        if (report.status == Status::diverged) step_best = sweep_best = std::nan("");
      }
      size.push_back(count);
      step_time.push_back(step_best);
      sweep_time.push_back(sweep_best);
    }
    const double by_step = fitted_order(size, step_time), by_sweep = fitted_order(size, sweep_time);
    for (std::size_t i = 0; i < size.size(); ++i)
      table.row({std::string(relaxation), static_cast<std::int64_t>(size[i]), step_time[i], sweep_time[i],
                 by_step, by_sweep, std::string(std::isnan(step_time[i]) ? "diverged" : "ok"),
                 std::string("fixed work")});
    context.verdict("joints.linear." + std::string(relaxation),
                    "a linearisation of a chain, and a sweep, cost time linear in its length",
                    "exponent from 50 to 3200 bodies", by_sweep, 1.1);
  }
  table.close();
}

}  // namespace

/// A step of each mechanism on its way, and of a top.
std::vector<Case> joints_cases(bool) {
  constexpr int lead_steps = 20;
  std::vector<Case> all;
  for (const auto& mechanism : mechanisms(false)) {
    const double h = mechanism.duration / mechanism.coarsest_steps;
    all.push_back({mechanism.name, mechanism.scene, h, h, lead_steps});
  }
  all.push_back({"heavy top", heavy_top(0.5, 100, 2), 1e-3, 1e-3, lead_steps});
  all.push_back({"heavy top on a spring", heavy_top(0.5, 100, 2, 1e-4), 1e-3, 1e-3, lead_steps});
  return all;
}

void joints(Context& context) {
  const auto all = mechanisms(context.full());
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
  context.verdict("joints.error_m", "joints hold in each step", "largest error of a length, m",
                  error_m.value(), 1e-10);
  context.verdict("joints.error_rad", "joints hold in each step", "largest error of an angle, rad",
                  error_rad.value(), 1e-10);
  lengths(context);
  context.advance("chains of 50 to 3200 bodies");
}

}  // namespace pbdcheck
