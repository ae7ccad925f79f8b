// Does plain contract in contact, resting, rolling and sliding, and at the predicted rate? The rate is
// measured beside the solution and compared with the spectral radius of the map's derivative by a judge.
#include "contact_contraction.h"

#include <cmath>

#include <fmt/format.h>

#include "harness/measure.h"
#include "harness/step_checks.h"
#include "studies/experiments.h"
#include "studies/iteration/contact_bodies.h"
#include "studies/iteration/measured_rate.h"

namespace pbdcheck {
namespace {

using namespace pbd;

struct TouchingCase {
  std::string scene, friction;
  Scene start;
  double h;
};

/// Both solve the step to 1e-12; errors are larger by the condition of its equations, which 1e3 allows for.
constexpr double most_apart = 1e-9;

struct TouchingRate {
  reference::ContactContraction judged;
  double predicted = std::nan(""), measured = std::nan("");
  bool returns = false;
  double apart = std::nan("");  // the judge's solution and the solver's, of the step
  bool solved() const { return judged.solved.outcome == reference::Outcome::ok && apart <= most_apart; }
  bool smooth() const { return solved() && !std::isnan(judged.rate.radius()); }
};

std::vector<TouchingCase> touching_cases(bool full) {
  std::vector<double> steps{1.0 / 30, 1.0 / 60, 1.0 / 120, 1.0 / 240};
  if (full) steps = {1.0 / 15, 1.0 / 30, 1.0 / 42, 1.0 / 60, 1.0 / 85, 1.0 / 120, 1.0 / 240, 1.0 / 480};
  std::vector<TouchingCase> all;
  for (const auto& body : touching_bodies())
    for (const char* friction : {"coulomb", "cone"})
      for (const double h : steps) all.push_back({body.name, friction, body.make(), h});
  return all;
}

/// The judge begins where an outer iteration ends that finds the step also where plain does not.
TouchingRate find_touching(const TouchingCase& problem) {
  const State& start = problem.start.initial;
  Method method;
  method.outer = "proximal";
  method.relaxation = "direct";
  method.friction = problem.friction;
  method.tolerance = 1e-12;
  method.max_outer = 1000;
  Workspace workspace(problem.start, method);
  State end = start;
  const Report report = step(workspace, problem.h, end);
  TouchingRate found;
  found.predicted = report.contraction;
  found.judged = reference::plain_contraction_of_contacts(
      claim_of(problem.start, workspace, start, end, problem.h, report));
  if (found.judged.solved.outcome == reference::Outcome::ok)
    found.apart = distance_from(problem.start, start, found.judged.solved, end);
  if (!found.solved()) return found;
  found.measured = measured_map_rate(problem.start, start, problem.h, found.judged.solved, problem.friction);
  constexpr int enough = 400;  // iterations: at a rate of 0.95 the error falls by 1e-8
  found.returns =
      plain_returns(problem.start, start, problem.h, found.judged.solved, enough, problem.friction);
  return found;
}

void write_touching(Context& context, const std::vector<TouchingCase>& all,
                    const std::vector<TouchingRate>& found) {
  Table table = context.table(
      "rates", {"scene", "friction", "step_s", "sticking", "sliding", "margin", "predicted_rate",
                "predicted_contraction", "measured_rate", "returns", "status", "reason"});
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto& [judged, predicted, measured, returns, apart] = found[k];
    const bool smooth = found[k].smooth(), solved = found[k].solved();
    table.row({all[k].scene, all[k].friction, all[k].h, std::int64_t{judged.sticking},
               std::int64_t{judged.sliding}, judged.margin, smooth ? judged.rate.radius() : std::nan(""),
               predicted, measured, std::int64_t{returns},
               smooth   ? "ok"
               : solved ? "skipped"
                        : "not_converged",
               smooth              ? ""
               : solved            ? "the map has a kink at the solution"
               : std::isnan(apart) ? judged.solved.reason
                                   : fmt::format("the judge's solution is {:.3g} of the step away", apart)});
  }
  table.close();
}

void judge_touching(Context& context, const std::vector<TouchingRate>& all) {
  constexpr double least = 0.01, below = 0.95, beyond = 1.05;
  Worst sticking, sliding;
  int compared = 0, judged = 0, contracting = 0, expanding = 0, lost = 0, wrong = 0;
  for (const TouchingRate& each : all) {
    judged += each.solved();
    if (!each.smooth()) continue;
    const double radius = each.judged.rate.radius();
    contracting += radius < below;
    lost += radius < below && !each.returns;
    expanding += radius > beyond;
    wrong += radius > beyond && each.returns;
    if (radius < least) continue;
    ++compared;
    (each.judged.sliding > 0 ? sliding : sticking).add(std::abs(each.measured / radius - 1));
  }
  // The map is measured from 1e-6 of the step away, so that each of its entries is off by some 1e-6 at most;
  // of a radius of 0.01 or more that is 1e-4, and ten times that if its modes are ten times longer than they
  // are apart.
  constexpr double bound = 1e-3;
  const std::string statement = fmt::format(
      "the solver's map has the radius of the judge's where that is {:g} or more ({} of {} cases), ", least,
      compared, all.size());
  context.verdict(Basis::theory, "contact_contraction.sticking", statement + "contacts stick",
                  "largest |measured/radius - 1|", sticking.value(), bound);
  context.verdict(Basis::theory, "contact_contraction.sliding", statement + "contacts slide",
                  "largest |measured/radius - 1|", sliding.value(), bound);
  context.verdict(Basis::theory, "contact_contraction.returns",
                  fmt::format("plain returns to the solution where the radius is below {:g}", below),
                  fmt::format("of {} cases, those where it does not", contracting),
                  contracting > 0 ? lost : std::nan(""), 0);
  context.verdict(Basis::theory, "contact_contraction.expands",
                  fmt::format("plain does not return where the radius exceeds {:g}", beyond),
                  fmt::format("of {} cases, those where it does", expanding),
                  expanding > 0 ? wrong : std::nan(""), 0);
  context.verdict(Basis::code, "contact_contraction.judged",
                  "the judge's equations have the step as their solution",
                  fmt::format("of {} cases, those where they have not", all.size()),
                  static_cast<double>(std::ssize(all) - judged), 0);
}

}  // namespace

void contact_contraction(Context& context) {
  const auto all = touching_cases(context.full());
  std::vector<TouchingRate> found(all.size());
  context.begin(1);
  context.parallel(std::ssize(all), [&](std::int64_t index) {
    found[static_cast<std::size_t>(index)] = find_touching(all[static_cast<std::size_t>(index)]);
  });
  write_touching(context, all, found);
  judge_touching(context, found);
  context.advance("rates");
}

}  // namespace pbdcheck
