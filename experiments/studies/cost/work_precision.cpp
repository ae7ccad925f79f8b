// What accuracy costs: error against the judge over seconds, row updates and outer iterations, for every
// outer iteration and relaxation, over tolerance and step, and for every law of friction; the judges' and
// rivals' own times on the same axes.
#include <algorithm>
#include <cmath>

#include "cones/contact_judge.h"
#include "error.h"
#include "harness/judges.h"
#include "harness/measure.h"
#include "judge.h"
#include "linear/linear_names.h"
#include "outer/outer_names.h"
#include "scenes/arch.h"
#include "scenes/contacts.h"
#include "scenes/standard.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;

std::vector<std::string> precision_columns() {
  return {"scene",    "step_s",    "integrator",       "outer",  "relaxation",
          "friction", "tolerance", "outer_iterations", "sweeps", "row_updates",
          "wall_s",   "error",     "status",           "reason"};
}

/// What a row is about; no law of friction where there are no contacts.
struct Subject {
  const Case& each;
  std::string friction;
};

void add_point(Table& table, const Subject& of, std::string_view outer, std::string_view relaxation,
               double tolerance, const TracePoint& point, std::string_view status, std::string_view reason) {
  table.row({of.each.name, of.each.h, "implicit_euler", std::string(outer), std::string(relaxation),
             of.friction, tolerance, std::int64_t{point.outer_iterations}, point.sweeps, point.row_updates,
             point.wall_s, point.error, std::string(status), std::string(reason)});
}

/// The judges' own times: the smallest of `timed_repeats` after a discarded run.
void judge_points(const Case& each, const State& start, const Points& exact, Table& table) {
  for (const auto& judge : reference::judges()) {
    judge.judge(each.scene, start, each.h);
    auto judged = judge.judge(each.scene, start, each.h);
    for (int repeat = 1; repeat < timed_repeats; ++repeat)
      judged.seconds = std::min(judged.seconds, judge.judge(each.scene, start, each.h).seconds);
    const TracePoint point{.outer_iterations = judged.iterations,
                           .wall_s = judged.seconds,
                           .error = relative_error(judged.x, exact, start.x),
                           .residual = judged.residual};
    add_point(table, {each, ""}, "judge", judge.name, 0, point,
              reference::outcome_names[static_cast<std::size_t>(judged.outcome)], judged.reason);
  }
}

/// One row a tolerance by `solve`; the tighter ones are skipped where one was missed, all of them where the
/// scene does not allow the method. Returns the tightest, without an error where that was not reached.
TracePoint tolerance_points(const Subject& of, std::string_view outer, std::string_view relaxation,
                            const std::function<Trace(double)>& solve, Table& table) {
  std::string skipped;
  TracePoint point;
  for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    point = {.wall_s = std::nan(""), .error = std::nan("")};
    std::string_view status = "skipped";
    std::string reason = skipped;
    try {
      if (skipped.empty()) {
        const Trace trace = measure([&] { return solve(tolerance); });
        point = trace.points.back();
        status = status_names[static_cast<std::size_t>(trace.report.status)];
        reason = trace.report.reason;
        if (trace.report.status != Status::ok) skipped = "a looser tolerance was not reached";
      }
    } catch (const SetupError& error) {
      reason = skipped = error.what();
    }
    add_point(table, of, outer, relaxation, tolerance, point, status, reason);
    if (!skipped.empty()) point.error = std::nan("");
  }
  return point;
}

void method_points(const Case& each, const State& start, const Points& exact, const OuterName& outer,
                   std::string_view relaxation, int max_outer, Table& table) {
  Method method;
  method.outer = outer.name;
  method.max_outer = max_outer;
  method.max_sweeps = std::min(method.max_sweeps, 4 * max_outer);  // so that hopeless ones end early
  if (outer.name != "quasi_newton") method.relaxation = relaxation;
  const auto solve = [&](double tolerance) {
    method.tolerance = tolerance;
    return measure_once(each.scene, start, each.h, method, exact);
  };
  tolerance_points({each, ""}, outer.name, relaxation, solve, table);
}

/// As many iterations as a plain method has sweeps in all: rivals that sweep have no inner ones.
void rival_points(const Case& each, const State& start, const Points& exact, int max_outer, Table& table) {
  const int max_iterations = max_outer * std::min(Method{}.max_sweeps, 4 * max_outer);
  for (const auto& rival : rivals::rivals()) {
    if (!rival.solves_step) continue;
    const auto solve = [&](double tolerance) {
      return measure_once(each.scene, start, each.h, rival, {tolerance, max_iterations}, exact);
    };
    tolerance_points({each, ""}, "rival", rival.name, solve, table);
  }
}

/// The relaxations that make a difference to an outer iteration.
std::vector<std::string_view> relaxations_for(const OuterName& outer) {
  return outer.name == "quasi_newton" ? std::vector<std::string_view>{"none"} : general_solver_names();
}

/// A box that slides askew down a slope, a column and an arch that are struck, and a pile of bodies that
/// stick, slide and leave each other.
std::vector<Case> contact_cases_of_work(bool full) {
  const auto struck = [](Scene scene, int body, const Vec3& velocity) {
    scene.initial.v.col(body) = velocity;
    return scene;
  };
  constexpr double slope = 0.35;  // rad
  const int stones = full ? 25 : 7;
  const Arch arch{1.2 * limit_thickness(stones), stones};
  std::vector<Case> all{{"incline", sliding_box(slope, 0.3, 0.5, 0.5), 0.01},
                        {"stack", struck(column(full ? 20 : 5), full ? 20 : 5, {0.5, 0.3, 0}), 0.01},
                        {"pile", pile(), 0.01},
                        {"arch", struck(arch.scene(), 1 + stones / 2, {0.02, 0.01, -0.2}), 0.01}};
  for (Case& each : all)  // which the judges of contact problems do not know
    std::erase_if(each.scene.effects, [](const Effect& e) { return std::holds_alternative<Gyroscopic>(e); });
  return all;
}

/// The first judge's end of the step, and the times of all, of cone_ipopt by the convex law alone: under
/// Coulomb's it takes minutes.
Points judge_contact_points(const Case& each, reference::FrictionLaw law, Table& table) {
  const State& start = each.scene.initial;
  const Points begin = places(each.scene, start.x, start.orientation);
  const std::string friction(reference::friction_law_names[static_cast<std::size_t>(law)]);
  Points exact;
  for (const ConeSolver& judge : cone_solvers()) {
    if (judge.kind != ConeSolverKind::judge) continue;
    if (judge.name == "cone_ipopt" && law == reference::FrictionLaw::coulomb) {
      add_point(table, {each, friction}, "judge", judge.name, 0,
                {.wall_s = std::nan(""), .error = std::nan("")}, "skipped", "minutes under Coulomb's law");
      continue;
    }
    const auto once = [&] { return judge_contacts(judge, each.scene, start, each.h, law); };
    ContactJudgement judged = once();
    for (int repeat = 1; repeat < timed_repeats && judged.status == "ok"; ++repeat)
      judged.seconds = std::min(judged.seconds, once().seconds);
    const Points end = places(each.scene, judged.end.x, judged.end.orientation);
    if (exact.size() == 0) {
      if (judged.status != "ok")
        throw std::runtime_error(judge.name + " found no step to compare with: " + judged.reason);
      exact = end;
    }
    add_point(table, {each, friction}, "judge", judge.name, 0,
              {.outer_iterations = judged.iterations,
               .wall_s = judged.seconds,
               .error = relative_error(end, exact, begin)},
              judged.status, judged.reason);
  }
  return exact;
}

/// Every relaxation by every law. Coulomb's law may have several solutions: where the motions of all that
/// meet the tightest tolerance are the judge's, errors mean something. box is beside Coulomb's law.
void contact_points(Context& context, const Case& each, int max_outer, Table& table) {
  const Points convex = judge_contact_points(each, reference::FrictionLaw::cone, table);
  const Points coulomb = judge_contact_points(each, reference::FrictionLaw::coulomb, table);
  Worst apart;
  for (const std::string_view friction : friction_names)
    for (const auto relaxation : general_solver_names()) {
      Method method;
      method.friction = friction;
      method.relaxation = relaxation;
      method.max_outer = max_outer;
      const auto solve = [&](double tolerance) {
        method.tolerance = tolerance;
        return measure_once(each.scene, each.scene.initial, each.h, method,
                            friction == "cone" ? convex : coulomb);
      };
      const TracePoint last =
          tolerance_points({each, std::string(friction)}, method.outer, relaxation, solve, table);
      if (friction != "box" && std::isfinite(last.error)) apart.add(last.error);
    }
  context.verdict(Basis::code, "work_precision." + each.name,
                  "who meets the tightest tolerance finds the judge's motion",
                  "largest relative error of the motion", apart.value(), 1e-6);
}

}  // namespace

std::vector<Case> work_precision_cases(bool full) {
  constexpr double lead = 1.0 / 100;
  std::vector<Case> all;
  for (const double h : {1.0 / 240, 1.0 / 60}) {
    all.push_back({"chain20", chain(20), h, lead, 25});
    all.push_back({"chain20 tip x100", chain(20, 100), h, lead, 25});
    all.push_back({full ? "cloth20" : "cloth10", cloth(full ? 20 : 10), h, lead, 25});
    all.push_back({"cantilever E=1e5 Pa", cantilever(8, {1e5, 0.3}, Strain::green), h, lead, 10});
    all.push_back({"cantilever E=1e6 Pa", cantilever(8, {1e6, 0.3}, Strain::green), h, lead, 10});
  }
  return all;
}

void work_precision(Context& context) {
  const auto points = work_precision_cases(context.full()), contacts = contact_cases_of_work(context.full());
  const int budget = context.full() ? 1000 : 50;  // outer iterations
  context.begin(std::ssize(points) + std::ssize(contacts));
  Table table = context.table("points", precision_columns());
  for (const auto& each : points) {
    const State start = start_of(each);
    const Points exact = truth(each.scene, start, each.h).x;
    for (const auto& outer : outer_names())
      for (const auto& relaxation : relaxations_for(outer))
        method_points(each, start, exact, outer, relaxation, budget, table);
    rival_points(each, start, exact, budget, table);
    judge_points(each, start, exact, table);
    context.advance(each.name);
  }
  table.close();
  Table touching = context.table("contacts", precision_columns());
  for (const auto& each : contacts) {
    contact_points(context, each, budget, touching);
    context.advance(each.name);
  }
  touching.close();
}

}  // namespace pbdcheck
