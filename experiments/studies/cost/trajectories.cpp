// What accuracy at the end of a motion costs in time and memory: integrator, outer iteration, relaxation, law
// of friction, step and tolerance, beside an ODE, a closed form or a far finer run.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "error.h"
#include "harness/integrator_rules.h"
#include "harness/measure.h"
#include "harness/order_fit.h"
#include "linear/linear_names.h"
#include "outer/outer_names.h"
#include "scenes/contacts.h"
#include "studies/cost/moving_scenes.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr double lost = 3;  // true motions from the start: what is there has blown up

/// A way to simulate, but for step and tolerance; `by_count` has no tolerance.
struct Way {
  Method method{};
  bool by_count = false;
};

/// Those that end where they are after a fixed number of iterations, as in engines: increments of positions
/// from zero impulses, as XPBD takes them (macklin2016xpbd; a sweep's rows are linearised together), and
/// velocity steps from the last impulses, as projected Gauss-Seidel does.
std::vector<Way> counted_ways() {
  std::vector<Way> ways;
  for (const auto* outer : {"incremental", "frozen"})
    for (const int count : {1, 10}) {
      Way way{.by_count = true};
      way.method.outer = outer;
      way.method.relaxation = "gauss_seidel";
      way.method.max_outer = outer == std::string_view("frozen") ? 1 : count;
      way.method.max_sweeps = outer == std::string_view("frozen") ? count : 1;
      way.method.tolerance = 0;
      way.method.warm_start = outer == std::string_view("frozen");
      ways.push_back(way);
    }
  return ways;
}

/// What the quick tier does: the other integrators and laws of friction by `auto` and `direct` alone, of dear
/// scenes no other law; by implicit Euler under Coulomb's law more pairs of outer iteration and relaxation,
/// of the dearest scenes the outer iterations that know a potential. Where explicit forces throw a cloth
/// apart its contacts take 10 s a step: not of dear scenes.
bool is_quick(const Way& way, int dear) {
  const Method& m = way.method;
  const bool usual_pair = m.outer == "auto" && m.relaxation == "direct";
  const bool euler = m.integrator == "implicit_euler", coulomb = m.friction == "coulomb";
  if (dear > 0 && (!coulomb || m.integrator == "symplectic_euler")) return false;
  if (dear > 1 && m.outer != "auto" && m.outer != "quasi_newton") return false;
  if (!euler || !coulomb) return usual_pair && (euler || coulomb);
  return m.relaxation == "direct" || m.relaxation == "conjugate_gradients" ||
         (m.outer == "auto" && m.relaxation != "jacobi");
}

/// All combinations in the full tier.
std::vector<Way> ways_of(const MovingScene& scene, bool full) {
  std::vector<Way> ways = counted_ways();
  const bool contact = contact_of(scene.file.scene) != nullptr;
  const std::vector<std::string_view> laws(friction_names.begin(),
                                           contact ? friction_names.end() : friction_names.begin() + 1);
  Way way;
  way.method.max_outer = full ? 100 : 50;
  way.method.max_sweeps = 4 * way.method.max_outer;  // so that hopeless ones end early
  for (const Rule& rule : integrator_rules({way.method.alpha}))
    for (const std::string_view friction : laws)
      for (const OuterName& outer : outer_names())
        for (const std::string_view relaxation : general_solver_names()) {
          way.method.integrator = rule.method.integrator;
          way.method.friction = friction;
          way.method.outer = outer.name;
          way.method.relaxation = relaxation;
          const bool another = outer.name != "quasi_newton" || relaxation == "direct";  // it relaxes nothing
          if (outer.solves_step && another && (full || is_quick(way, scene.dear))) ways.push_back(way);
        }
  return ways;
}

/// One scene's rows, and what the verdicts need of them.
class Runs {
 public:
  Runs(const MovingScene& scene, Table& table)
      : scene_(scene),
        table_(table),
        bar_(agreed_truth(scene.file, scene.duration, scene.finest, scene.integrators)),
        truth_(scene.exact ? scene.exact(scene) : bar_) {}

  /// Returns the errors at the tightest tolerance, from the longest step to the shortest.
  std::vector<double> add(const Way& way, bool full) {
    std::vector<double> errors;
    std::vector<double> tolerances{1e-2, 1e-5, 1e-8};
    if (full) tolerances = {1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10};
    if (way.by_count) tolerances = {0};
    for (int level = 0; level < scene_.levels; ++level) {
      std::string skipped;
      for (const double tolerance : tolerances) {
        Setting setting{way.method, scene_.coarsest << level, way.by_count};
        setting.method.tolerance = tolerance;
        const double error = row(setting, skipped);
        if (tolerance == tolerances.back()) errors.push_back(error);
      }
    }
    return errors;
  }

  /// How many bars the finest run is from a better truth; none where there is none.
  std::optional<double> bars_off() const {
    if (!scene_.exact) return {};
    const Trajectory finest{.end = bar_.end};
    return end_error(scene_.file.scene, finest, truth_.end) / bar_.error_bar;
  }

  double error_bar() const { return truth_.error_bar; }
  const std::string& truth() const { return truth_.method; }

 private:
  double row(const Setting& setting, std::string& skipped) {
    const Method& m = setting.method;
    Trajectory found;
    std::string status = "skipped";
    double error = std::nan(""), energy = error, memory = error;
    found.wall_s = error;
    if (skipped.empty()) try {
        found = timed_trajectory(scene_.file, scene_.duration, setting,
                                 {.way_m = lost * way(scene_.file.scene, truth_.end)});
        error = end_error(scene_.file.scene, found, truth_.end);
        energy = energy_error(scene_.file.scene, found, truth_.end);
        status = status_cell(found.status);
        if (found.status == Status::ok)
          memory = step_memory_mb(scene_.file, scene_.duration, setting, found.end);
        else
          skipped = "a looser tolerance was not reached";
      } catch (const SetupError& error) {
        found.reason = skipped = error.what();
      }
    else
      found.reason = skipped;
    std::vector<Cell> cells{scene_.name, scene_.duration,
                            scene_.duration / static_cast<double>(setting.steps)};
    const auto add = [&](const std::vector<Cell>& more) {
      cells.insert(cells.end(), more.begin(), more.end());
    };
    add(method_cells(scene_.file.scene, m));
    add({std::int64_t{setting.by_count ? m.max_outer * m.max_sweeps : 0}});
    add(work_cells(found));
    add({memory, error, truth_.error_bar, energy, found.penetration_m, truth_.method, status, found.reason});
    table_.row(cells);
    return error;
  }

  const MovingScene& scene_;
  Table& table_;
  Truth bar_, truth_;
};

/// The midpoint rule is marginal with hard constraints; incomplete solves have errors of their own.
bool judged_for_order(const Way& way) {
  const Method& m = way.method;
  return !way.by_count && m.outer == "auto" && m.relaxation == "direct" && m.integrator != "midpoint";
}

double order_error(const Way& way, const MovingScene& scene, const std::vector<double>& errors) {
  const auto rules = integrator_rules({Method{}.alpha});
  const auto rule = std::find_if(rules.begin(), rules.end(), [&](const Rule& each) {
    return each.method.integrator == way.method.integrator;
  });
  const double step = scene.duration / static_cast<double>(scene.coarsest << (scene.levels - 1));
  return std::abs(fitted_order({2 * step, step}, {errors.end() - 2, errors.end()}) - rule->order);
}

}  // namespace

void trajectories(Context& context) {
  const auto scenes = moving_scenes(context.full());
  context.begin(std::ssize(scenes));
  Table table = context.table(
      "runs", {"scene",        "duration_s",    "step_s", "integrator",       "outer",  "relaxation",
               "friction",     "tolerance",     "count",  "outer_iterations", "sweeps", "row_updates",
               "missed_steps", "bytes",         "wall_s", "memory_mb",        "error",  "error_bar",
               "energy_error", "penetration_m", "truth",  "status",           "reason"});
  Worst bars, orders;
  for (const MovingScene& scene : scenes) {
    Runs runs(scene, table);
    for (const Way& way : ways_of(scene, context.full())) {
      const auto errors = runs.add(way, context.full());
      if (scene.resolved && judged_for_order(way))
        orders.add(order_error(way, scene, errors), fmt::format("{}, {}", scene.name, way.method.integrator));
    }
    if (const auto off = runs.bars_off()) bars.add(*off, scene.name);
    context.advance(fmt::format("{}: {}, error bar {:.2g}", scene.name, runs.truth(), runs.error_bar()));
  }
  table.close();
  context.verdict(Basis::theory, "trajectories.orders",
                  "where steps resolve the motion, the order of the last halving rounds to the integrator's",
                  fmt::format("|order - integrator's| ({})", orders.owner()), orders.value(), 0.5);
  context.verdict(Basis::code, "trajectories.bars",
                  "where a truth is known, the finest run is within three of its own error bars of it",
                  fmt::format("bars between the two ({})", bars.owner()), bars.value(), 3);
}

}  // namespace pbdcheck
