// How fast do the outer iterations approach the implicit Euler step, and when does the paper's fixed point
// not? Near the solution the plain iteration's error is multiplied by the geometric stiffness it leaves out,
// projected onto the motions that the constraints allow; the reference computes that spectral radius densely.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "contraction.h"
#include "harness/judges.h"
#include "harness/measure.h"
#include "scenes/standard.h"
#include "studies/experiments.h"
#include "studies/iteration/measured_rate.h"
#include "studies/iteration/outer_residuals.h"

namespace pbdcheck {
namespace {

using namespace pbd;

/// Errors after each outer iteration, linear problems solved by `relaxation`.
struct OuterCourse {
  std::vector<double> error;
  Report report;
};

OuterCourse course(const Scene& scene, const State& start, double h, const Points& reference,
                   std::string_view outer, std::string_view relaxation, int iterations) {
  Method method;
  method.outer = outer;
  method.relaxation = relaxation;
  method.tolerance = 1e-12;
  method.max_outer = iterations;
  Workspace workspace(scene, method);
  State state = start;
  OuterCourse found;
  found.report = step(workspace, h, state, [&](const Iterate& iterate) {
    found.error.push_back(relative_error(iterate.x, reference, start.x));
  });
  return found;
}

/// converged: at rounding; converging: falls steadily; diverging: larger than the step itself; oscillating:
/// neither.
std::string behaviour(const std::vector<double>& error) {
  const double last =
      *std::max_element(error.end() - std::min<std::ptrdiff_t>(10, std::ssize(error)), error.end());
  if (!std::isfinite(error.back()) || !(last <= 1)) return "diverging";
  if (error.back() < 1e-10) return "converged";
  return last < 1e-3 * error.front() ? "converging" : "oscillating";
}

constexpr double lead_step = 1.0 / 100;  // s
constexpr int chain_lead_steps = 30;

std::vector<Case> pendulums() {
  std::vector<Case> all;
  for (const double h : {0.2, 0.1, 0.05}) all.push_back({"pendulum", pendulum(0.3, 2), h});
  return all;
}

Case cantilever_case(double young) {
  return {fmt::format("cantilever E={:g} Pa", young), cantilever(8, {young, 0.3}, Strain::green), 1.0 / 60,
          lead_step, chain_lead_steps};
}

void write_outer_course(Table& table, const std::string& scene, double h, double ratio,
                        std::string_view outer, std::string_view relaxation, const OuterCourse& found) {
  for (std::size_t k = 0; k < found.error.size(); ++k)
    table.row({scene, h, ratio, std::string(outer), std::string(relaxation), static_cast<std::int64_t>(k),
               found.error[k], std::string(status_names[static_cast<std::size_t>(found.report.status)]),
               std::string(found.report.reason)});
}

void pendulum_rates(Context& context, Table& errors, Table& map) {
  for (const auto& [name, scene, h, lead, steps] : pendulums()) {
    const auto judged = truth(scene, scene.initial, h);
    const double predicted = reference::plain_contraction(scene, judged.x, judged.multiplier, h).radius();
    const OuterCourse found = course(scene, scene.initial, h, judged.x, "plain", "direct", 60);
    const double measured = measured_rate(scene, scene.initial, h, judged);
    write_outer_course(errors, "pendulum", h, 1, "plain", "direct", found);
    map.row({"pendulum", h, 1.0, "plain", predicted, measured, behaviour(found.error), found.error.back(),
             std::string(status_names[static_cast<std::size_t>(found.report.status)]),
             std::string(found.report.reason)});
    // An iteration is measured that begins 1e-6 of the step away: curvature changes its rate by about that.
    context.verdict(Basis::theory, "outer.pendulum_rate." + std::to_string(h).substr(0, 4),
                    "the plain iteration contracts a pendulum's error by h^2 T/(m l)",
                    "|measured/predicted - 1|", std::abs(measured / predicted - 1), 1e-5);
    context.advance("pendulum");
  }
}

struct Curve {
  std::string name;
  double ratio;
  Case step;
};

std::vector<Curve> curves() {
  std::vector<Curve> all;
  for (const double ratio : {1.0, 100.0, 1000.0})
    for (const double h : {1.0 / 240, 1.0 / 60}) all.push_back({"chain20", ratio, swinging_chain(ratio, h)});
  for (const double young : {1e5, 1e6}) {
    Case step = cantilever_case(young);
    all.push_back({step.name, 1, std::move(step)});
  }
  return all;
}

void error_curves(Context& context, Table& errors) {
  Worst proximal;
  for (const auto& [name, ratio, each] : curves()) {
    const State start = start_of(each);
    const auto judged = truth(each.scene, start, each.h);
    for (const auto& [outer, relaxation, iterations] : {std::tuple{"plain", "direct", 60},
                                                        {"plain", "nesterov_jacobi", 60},
                                                        {"proximal", "direct", 60},
                                                        {"auto", "direct", 200},
                                                        {"incremental", "direct", 60},
                                                        {"incremental", "gauss_seidel", 200},
                                                        {"frozen", "direct", 3}}) {
      const OuterCourse found = course(each.scene, start, each.h, judged.x, outer, relaxation, iterations);
      write_outer_course(errors, name, each.h, ratio, outer, relaxation, found);
      if (outer == std::string_view("proximal")) proximal.add(found.error.back());
    }
    context.advance(name);
  }
  context.verdict(Basis::code, "outer.proximal",
                  "proximal finds the step in at most 60 iterations in every traced case", "largest error",
                  proximal.value(), 1e-10);
}

struct OuterCell {
  double h, ratio, predicted, measured;
  std::string behaviour;
  OuterCourse course;
};

void chain_map(Context& context, Table& map) {
  const auto ratios = chain_ratios(context.full());
  const auto steps = chain_steps(context.full());
  std::vector<OuterCell> cells(ratios.size() * steps.size());
  context.parallel(std::ssize(ratios), [&](std::int64_t r) {
    const double ratio = ratios[static_cast<std::size_t>(r)];
    const State start = start_of(swinging_chain(ratio, 0));
    for (std::size_t s = 0; s < steps.size(); ++s) {
      const auto [name, scene, h, lead, lead_count] = swinging_chain(ratio, steps[s]);
      const auto judged = truth(scene, start, h);
      OuterCell& cell = cells[static_cast<std::size_t>(r) * steps.size() + s];
      cell = {h, ratio, reference::plain_contraction(scene, judged.x, judged.multiplier, h).radius(),
              0, "",    course(scene, start, h, judged.x, "plain", "direct", 1000)};
      cell.measured = measured_rate(scene, start, h, judged);
      cell.behaviour = behaviour(cell.course.error);
    }
  });

  Worst worst, claimed;
  for (const auto& cell : cells) {
    map.row({"chain20", cell.h, cell.ratio, "plain", cell.predicted, cell.measured, cell.behaviour,
             cell.course.error.back(),
             std::string(status_names[static_cast<std::size_t>(cell.course.report.status)]),
             std::string(cell.course.report.reason)});
    if (!(cell.predicted >= 0.95)) worst.add(std::abs(cell.measured / cell.predicted - 1));
    if (!(cell.predicted <= 1.05)) claimed.add(cell.course.report.status == Status::ok ? 1 : 0);
  }
  context.verdict(Basis::theory, "outer.chain_map.rate",
                  "measured rate equals the predicted spectral radius where that is < 0.95",
                  "largest |measured/predicted - 1|", worst.value(), 0.001);
  context.verdict(Basis::theory, "outer.chain_map.no_false_claim",
                  "no convergence is claimed where the predicted rate exceeds 1.05", "1 if a cell claims it",
                  claimed.value(), 0);
  context.advance("chain map");
}

}  // namespace

std::vector<Case> outer_convergence_cases(bool full) {
  std::vector<Case> all = pendulums();
  for (const double ratio : chain_ratios(full))
    for (const double h : chain_steps(full)) all.push_back(swinging_chain(ratio, h));
  for (const double young : {1e5, 1e6}) all.push_back(cantilever_case(young));
  return all;
}

void outer_convergence(Context& context) {
  context.begin(3 + std::ssize(curves()) + 2);
  Table errors = context.table("errors", {"scene", "step_s", "mass_ratio", "outer", "relaxation", "iteration",
                                          "error", "status", "reason"});
  Table map = context.table("map", {"scene", "step_s", "mass_ratio", "outer", "predicted_rate",
                                    "measured_rate", "behaviour", "error_final", "status", "reason"});
  pendulum_rates(context, errors, map);
  error_curves(context, errors);
  chain_map(context, map);
  errors.close();
  map.close();
  outer_residuals(context);
}

}  // namespace pbdcheck
