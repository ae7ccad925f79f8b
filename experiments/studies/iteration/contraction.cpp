// Is the contraction of the plain outer iteration the predicted one, effect by effect? Small bodies of one
// effect each are loaded, so that their geometric stiffness matters: the rate is measured beside the solution
// and compared with the dense spectral radius, the solver's own prediction and its bound for the effect.
#include "contraction.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "harness/judges.h"
#include "harness/measure.h"
#include "studies/experiments.h"
#include "studies/iteration/contraction_bodies.h"
#include "studies/iteration/measured_rate.h"

namespace pbdcheck {
namespace {

using namespace pbd;

struct ContractionCase : Case {
  OneEffectBody body;
  double stiffness, load;
};

std::vector<ContractionCase> rate_cases(bool full) {
  std::vector<double> steps{1.0 / 15, 1.0 / 21, 1.0 / 30, 1.0 / 60};
  if (full) steps = {1.0 / 15, 1.0 / 21, 1.0 / 30, 1.0 / 42, 1.0 / 60, 1.0 / 85, 1.0 / 120, 1.0 / 240};
  std::vector<ContractionCase> all;
  for (const auto& body : one_effect_bodies())
    for (const double stiffness : body.stiffnesses)
      for (const double load : body.loads)
        for (const double h : steps) {
          Scene scene = body.make(stiffness);
          load_and_stir(scene, load * body.direction);
          all.push_back(
              {{fmt::format("{} {} {:g} {}, {:g} N", body.effect, body.strain, stiffness, body.unit, load),
                scene, h},
               body,
               stiffness,
               load});
        }
  return all;
}

struct FoundRate {
  reference::Contraction dense;
  double predicted = 0, bound = 0, measured = 0;
};

constexpr double rounding = 1e-6;

/// Whether the stiffening part of the geometric stiffness decides the rate; where both parts are as large, it
/// does.
bool stiffens(const reference::Contraction& dense) {
  return -dense.smallest >= (1 - rounding) * dense.largest;
}

/// By an outer iteration that finds the step also where plain does not, and predicts by the same rows.
FoundRate find(const ContractionCase& problem) {
  const State& start = problem.scene.initial;
  const auto exact = truth(problem.scene, start, problem.h);
  Method method;
  method.outer = "proximal";
  method.relaxation = "direct";
  method.tolerance = 1e-12;
  method.max_outer = 1000;
  Workspace workspace(problem.scene, method);
  State end = start;
  const Report report = step(workspace, problem.h, end);
  double bound = 0;  // of the effects, and of turns that are linearised: h |w| / 2
  for (const auto& cost : workspace.costs()) bound += cost.contraction;
  if (!problem.scene.bodies.empty()) bound += problem.h / 2 * exact.spin.colwise().norm().maxCoeff();
  return {problem.scene.bodies.empty()
              ? reference::plain_contraction(problem.scene, exact.x, exact.multiplier, problem.h)
              : reference::plain_contraction_of_bodies(problem.scene, start, problem.h, exact),
          report.status == Status::ok ? report.contraction : std::nan(""), bound,
          measured_rate(problem.scene, start, problem.h, exact)};
}

void write_rates(Context& context, const std::vector<ContractionCase>& all,
                 const std::vector<FoundRate>& found) {
  Table table = context.table(
      "rates", {"effect", "strain", "step_s", "stiffness", "unit", "load_n", "predicted_rate", "stiffening",
                "predicted_contraction", "bound", "measured_rate", "status", "reason"});
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto& [dense, predicted, bound, measured] = found[k];
    const bool ok = !std::isnan(measured);
    table.row({all[k].body.effect, all[k].body.strain, all[k].h, all[k].stiffness, all[k].body.unit,
               all[k].load, dense.radius(), -dense.smallest, predicted, bound, measured,
               ok ? "ok" : "not_converged", ok ? "" : "the error does not fall at a steady rate"});
  }
  table.close();
}

void verdicts(Context& context, const std::vector<FoundRate>& all) {
  constexpr double worth_estimating = 0.7, measurable = 0.95;
  constexpr double comparable = 0.01;  // two iterations fit between the measured errors, 1e-6 and 1e-10
  Worst above, different, stiffened, softened;
  int compared = 0, still = 0, not_falling = 0;
  for (const auto& [dense, predicted, bound, measured] : all) {
    if (!(dense.radius() <= comparable) && !(dense.radius() >= measurable)) {
      different.add(std::abs(measured / dense.radius() - 1));
      ++compared;
    }
    still += measured == 0;
    not_falling += std::isnan(measured);
    if (measured == 0) continue;
    const double rate = std::isnan(measured) ? 1 : measured;  // of an error that does not fall 1 at least
    above.add(rate / bound);
    if (measured > worth_estimating && measured < measurable)
      (stiffens(dense) ? stiffened : softened).add(std::abs(predicted / measured - 1));
  }
  context.verdict(
      Basis::theory, "contraction.radius",
      fmt::format(
          "the measured rate is the dense spectral radius where that is from {:g} to {:g} ({} of {} cases)",
          comparable, measurable, compared, all.size()),
      "largest |measured/radius - 1|", different.value(), 0.01);
  context.verdict(
      Basis::theory, "contraction.bound",
      fmt::format("no measured rate exceeds the effect's bound ({} of {} cases, below {:g}, are left out; {} "
                  "whose error does not fall count as 1)",
                  still, all.size(), least_rate, not_falling),
      "largest measured/bound", above.value(), 1 + rounding);
  const std::string statement = "the solver predicts measured rates between 0.7 and 0.95, ";
  context.verdict(Basis::goal, "contraction.prediction_stiffening", statement + "stiffening decides",
                  "largest |predicted/measured - 1|", stiffened.value(), 0.05);
  context.verdict(Basis::goal, "contraction.prediction_softening", statement + "compression decides",
                  "largest |predicted/measured - 1|", softened.value(), 0.05);
}

}  // namespace

std::vector<Case> contraction_cases(bool full) {
  const auto all = rate_cases(full);
  return {all.begin(), all.end()};
}

void contraction(Context& context) {
  const auto all = rate_cases(context.full());
  std::vector<FoundRate> found(all.size());
  context.begin(1);
  context.parallel(std::ssize(all), [&](std::int64_t index) {
    found[static_cast<std::size_t>(index)] = find(all[static_cast<std::size_t>(index)]);
  });
  write_rates(context, all, found);
  verdicts(context, found);
  context.advance("rates");
}

}  // namespace pbdcheck
