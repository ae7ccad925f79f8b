// When is quasi_newton, which factors one constant matrix a scene, faster than Newton's method, which factors
// the stiffness at every iterate? One step of a falling cantilever, for sizes and materials: seconds until
// the error first falls to a target. As in a running simulation, what only a scene's first step takes
// (making, ordering, the constant factor) stands apart, as setup_s.
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/judges.h"
#include "harness/measure.h"
#include "scenes/standard.h"
#include "studies/cost/contestants.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr int rival_lead_steps = 10;  // from rest
constexpr int most_cells = 44;        // cells along the beam
constexpr int largest_judged = 24;    // a judge takes minutes beyond
constexpr double targets[]{1e-3, 1e-6, 1e-10};
constexpr double rival_tolerance = 1e-12;

struct RivalProblem {
  int cells;
  Material material;
  Scene scene;
};

std::vector<RivalProblem> rival_problems(bool full) {
  std::vector<RivalProblem> all;
  for (const int n : {8, 16, 24, most_cells})
    for (const double young : {1e5, 1e6, 1e7})
      for (const double poisson : {0.3, 0.49})
        if (full || (n < most_cells && young == 1e6))
          all.push_back({n, {young, poisson}, cantilever(n, {young, poisson}, Strain::green)});
  return all;
}

struct MeasuredMethod {
  Trace trace;     // smallest times of the repeats
  double setup_s;  // by which making the method and its first step take longer than a later step
};

MeasuredMethod measure_rival(const Contestant& contestant, const Scene& scene, const State& start,
                             const Points& exact) {
  const double begun = now_s();
  const WatchedStep step = contestant.ready(scene, rival_tolerance);
  const double making = now_s() - begun;
  const double first = making + watched(step, start, exact).points.back().wall_s;
  const Trace trace = measure([&] { return watched(step, start, exact); });
  return {trace, std::max(0.0, first - trace.points.back().wall_s)};
}

/// The state before the step, and the step's end: by the judge, or where that takes too long by the rival.
struct Reference {
  State start;
  Points x;
};

Reference reference_of(const RivalProblem& problem, bool full) {
  const auto rival = rivals::rivals()[0].make(problem.scene, contested_step_s);
  const auto solve = [&](State& state, double accuracy) {
    const auto report = rival->step(state, {.tolerance = accuracy});
    if (report.status != rivals::Status::ok)
      throw std::runtime_error("newton found no step to compare with: " + std::string(report.reason));
  };
  Reference found{problem.scene.initial, {}};
  for (int k = 0; k < rival_lead_steps; ++k) solve(found.start, 1e-10);
  const bool judged = problem.cells < largest_judged || (full && problem.cells == largest_judged);
  State end = found.start;
  if (!judged) solve(end, 1e-13);
  found.x = judged ? truth(problem.scene, found.start, contested_step_s).x : end.x;
  return found;
}

/// The two tables, and what the verdicts need of them.
class Duel {
 public:
  explicit Duel(Context& context)
      : times_(context.table("times", {"scene", "elements", "young_pa", "poisson", "method", "error_target",
                                       "iterations", "setup_s", "wall_s", "error", "status", "reason"})),
        traces_(context.table("traces", {"scene", "elements", "young_pa", "poisson", "method", "iteration",
                                         "wall_s", "error", "status", "reason"})) {}

  void add(const RivalProblem& problem, const Contestant& contestant, const MeasuredMethod& measured) {
    const auto& report = measured.trace.report;
    const std::string status(status_names[static_cast<std::size_t>(report.status)]), reason(report.reason);
    for (const auto& point : measured.trace.points)
      row(traces_, problem, contestant,
          {std::int64_t{point.outer_iterations}, point.wall_s, point.error, status, reason});
    for (const double target : targets) {
      const auto& points = measured.trace.points;
      const auto first = std::find_if(points.begin(), points.end(),
                                      [=](const TracePoint& point) { return point.error <= target; });
      const bool reached = first != points.end();
      const TracePoint& point = reached ? *first : points.back();
      row(times_, problem, contestant,
          {target, std::int64_t{point.outer_iterations}, measured.setup_s, point.wall_s, point.error,
           reached          ? "ok"
           : status == "ok" ? "not_converged"
                            : status,
           reached          ? ""
           : reason.empty() ? "ended above the target"
                            : reason});
      seconds_[{&problem, target}].push_back(reached ? point.wall_s : std::nan(""));
    }
    if (&contestant == &contestants[0]) ends_.add(measured.trace.points.back().error);
  }

  /// Largest error that quasi_newton ends with.
  double worst_end() const { return ends_.value(); }

  /// Largest ratio of quasi_newton's seconds to newton's on the largest meshes that are compressible.
  double worst_ratio(double target) const {
    Worst worst;
    for (const auto& [key, seconds] : seconds_)
      if (key.second == target && key.first->cells == most_cells && key.first->material.poisson < 0.4)
        worst.add(seconds.at(0) / seconds.at(1));
    return worst.value();
  }

  void close() {
    times_.close();
    traces_.close();
  }

 private:
  static void row(Table& table, const RivalProblem& problem, const Contestant& contestant,
                  const std::vector<Cell>& cells) {
    const auto& tetrahedra = std::get<TetStrain>(problem.scene.effects.back()).node;
    std::vector<Cell> all{"cantilever", std::ssize(tetrahedra), problem.material.young,
                          problem.material.poisson, std::string(contestant.name)};
    all.insert(all.end(), cells.begin(), cells.end());
    table.row(all);
  }

  Table times_, traces_;
  std::map<std::pair<const RivalProblem*, double>, std::vector<double>>
      seconds_;  // of the contestants in order
  Worst ends_;
};

}  // namespace

void rival_newton(Context& context) {
  const auto all = rival_problems(context.full());
  context.begin(std::ssize(all));
  Duel duel(context);
  for (const auto& problem : all) {
    const auto [start, exact] = reference_of(problem, context.full());
    for (const auto& contestant : contestants)
      duel.add(problem, contestant, measure_rival(contestant, problem.scene, start, exact));
    context.advance(fmt::format("{} cells E={:g} nu={:g}", problem.cells, problem.material.young,
                                problem.material.poisson));
  }
  context.verdict(Basis::code, "rival.accuracy", "quasi_newton reaches the solution, nu = 0.49 included",
                  "largest error at its end", duel.worst_end(), 1e-10);
  if (context.full()) {
    const std::string statement =
        "on the largest meshes, nu = 0.3, quasi_newton is the faster one to an error of ";
    context.verdict(Basis::goal, "rival.coarse", statement + "1e-3", "largest ratio of its time to newton's",
                    duel.worst_ratio(1e-3), 1.0 / 3);
    context.verdict(Basis::goal, "rival.fine", statement + "1e-6", "largest ratio of its time to newton's",
                    duel.worst_ratio(1e-6), 1.0 / 2);
  }
  duel.close();
}

}  // namespace pbdcheck
