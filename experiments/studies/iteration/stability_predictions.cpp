// Does the solver predict where the plain outer iteration converges, beside dense matrices and beside what it
// does from close to the solution?
#include <cmath>
#include <numeric>

#include "contraction.h"
#include "harness/measure.h"
#include "studies/iteration/measured_rate.h"
#include "studies/iteration/stability_cells.h"

namespace pbdcheck {
namespace {

using namespace pbd;

struct RatePrediction {
  double radius = 0;     // of the dense matrices
  double predicted = 0;  // by the solver, at the end of the step by auto
  bool returns = false;  // plain does to the solution, from beside it

  /// NaN agrees with nothing.
  bool agrees() const { return returns ? predicted < 1 : predicted >= 1; }
};

std::vector<RatePrediction> predictions(const Context& context, const std::vector<MapCell>& cells) {
  std::vector<RatePrediction> all(cells.size());
  context.parallel(std::ssize(cells), [&](std::int64_t index) {
    const auto& cell = cells[static_cast<std::size_t>(index)];
    const auto& [name, scene, h, lead, lead_steps] = cell.step;
    const auto dense = reference::plain_contraction(scene, cell.exact.x, cell.exact.multiplier, h);
    all[static_cast<std::size_t>(index)] = {dense.radius(), solve_by_auto(cell).report.contraction,
                                            plain_returns(scene, cell.start, h, cell.exact, 1000)};
  });
  return all;
}

}  // namespace

void prediction_verdicts(Context& context, const std::vector<MapCell>& cells) {
  constexpr double undecided = 0.05, worth_estimating = 0.7;
  const auto all = predictions(context, cells);
  Table table = context.table("predictions", {"scene", "step_s", "mass_ratio", "predicted_rate",
                                              "predicted_contraction", "behaviour"});
  Worst rate;
  double decided = 0, wrong = 0;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const RatePrediction& found = all[k];
    table.row({"chain20", cells[k].step.h, cells[k].value, found.radius, found.predicted,
               found.returns ? "converged" : "oscillating"});
    if (std::abs(found.radius - 1) > undecided) ++decided, wrong += found.agrees() ? 0 : 1;
    if (found.radius > worth_estimating) rate.add(std::abs(found.predicted / found.radius - 1));
  }
  context.verdict(Basis::theory, "stability.predicted_convergence",
                  "predicted and measured convergence of plain agree where the radius is not within 5 % of 1",
                  "share of cells of the chain's map where they do not", wrong / decided, 0);
  context.verdict(Basis::goal, "stability.predicted_rate",
                  "the solver's prediction equals the dense spectral radius where that exceeds 0.7",
                  "largest |predicted/radius - 1|", rate.value(), 0.05);
  table.close();
}

void joint_verdict(Context& context, const std::vector<MapCell>& cells) {
  constexpr double undecided = 0.05;
  std::vector<int> wrong(cells.size(), 0), decided(cells.size(), 0);
  context.parallel(std::ssize(cells), [&](std::int64_t index) {
    const auto k = static_cast<std::size_t>(index);
    const auto& cell = cells[k];
    const double predicted = solve_by_auto(cell).report.contraction;
    if (std::abs(predicted - 1) <= undecided) return;
    decided[k] = 1;
    const bool returns = plain_returns(cell.step.scene, cell.start, cell.step.h, cell.exact, 1000);
    wrong[k] = !(returns ? predicted < 1 : predicted >= 1);
  });
  context.verdict(
      Basis::theory, "stability.predicted_joints",
      "predicted and measured convergence of plain agree on joints where the prediction is not "
      "within 5 % of 1",
      "share of cells of the rods' map where they do not",
      std::accumulate(wrong.begin(), wrong.end(), 0.0) / std::accumulate(decided.begin(), decided.end(), 0.0),
      0);
}

}  // namespace pbdcheck
