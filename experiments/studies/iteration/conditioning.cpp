// What do mass ratio, stiffness and near incompressibility do to the relaxations? Sweeps that one linearised
// step takes to a relative residual, or the residual reached. Conjugate gradients are held against
// Chebyshev's bound: in the norm of the residual, sqrt(kappa) 2 ((sqrt(kappa) - 1)/(sqrt(kappa) + 1))^k after
// k sweeps (Saad 2003, 6.11.3), kappa the condition of D^-1 N.
#include <cmath>

#include "contraction.h"
#include "harness/measure.h"
#include "harness/rows_of_step.h"
#include "linear/linear_solver.h"
#include "scenes/standard.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr double step_s = 1.0 / 60;
constexpr double target = 1e-6;  // residual, of that at the start

struct LinearProblem {
  std::string scene, parameter;
  double value;
  Scene start;
};

std::vector<LinearProblem> linear_problems() {
  std::vector<LinearProblem> all;
  for (const double ratio : {1.0, 10.0, 100.0, 1e3, 1e4})
    all.push_back({"chain20", "mass_ratio", ratio, chain(20, ratio)});
  for (const double young : {1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9})
    all.push_back({"cantilever nu=0.3", "young_pa", young, cantilever(4, {young, 0.3}, Strain::green)});
  for (const double poisson : {0.0, 0.3, 0.45, 0.49, 0.499, 0.4999})
    all.push_back({"cantilever E=1e6 Pa", "poisson", poisson, cantilever(4, {1e6, poisson}, Strain::green)});
  for (auto& problem : all) stir(problem.start);
  return all;
}

struct LinearSolve {
  std::int64_t sweeps = 0;
  double residual = 1;  // of that at the start
};

LinearSolve solve_linear(const LinearStep& step, std::string_view name, std::int64_t most_sweeps) {
  Rows rows = step.rows;
  Points v = step.v_free;
  const double first = residual(rows, v);
  LinearSolver any = make_linear_solver(name);
  LinearSolve found;
  std::visit(
      [&](auto& relaxation) {
        relaxation.begin(rows, v, true);
        while (found.residual > target && found.sweeps < most_sweeps) {
          relaxation.sweep(rows, v, nullptr);
          ++found.sweeps;
          found.residual = residual(rows, v) / first;
        }
        if constexpr (requires { relaxation.further_sweeps(); }) found.sweeps += relaxation.further_sweeps();
      },
      any);
  return found;
}

/// Sweeps of conjugate gradients to the target, by Chebyshev's bound.
double most_sweeps_of(double condition) {
  const double root = std::sqrt(condition);
  return std::ceil(std::log(target / (2 * root)) / std::log((root - 1) / (root + 1)));
}

struct Conditioned {
  double condition = 0;
  std::vector<LinearSolve> solves{};  // one a relaxation
};

}  // namespace

void conditioning(Context& context) {
  const auto all = linear_problems();
  const auto names = general_solver_names();
  const std::int64_t budget = context.full() ? 100000 : 10000;
  std::vector<Conditioned> found(all.size());
  context.begin(1);
  context.parallel(std::ssize(all), [&](std::int64_t index) {
    const Scene& scene = all[static_cast<std::size_t>(index)].start;
    const LinearStep step = linear_step(scene, scene.initial, step_s);
    auto& [condition, solves] = found[static_cast<std::size_t>(index)];
    condition = reference::relaxation_rates(scene, scene.initial.x, step_s).condition;
    for (const auto name : names) solves.push_back(solve_linear(step, name, budget));
  });

  Table table = context.table("sweeps", {"scene", "parameter", "value", "condition", "relaxation", "sweeps",
                                         "residual", "status", "reason"});
  Worst conjugate;
  for (std::size_t k = 0; k < all.size(); ++k)
    for (std::size_t n = 0; n < names.size(); ++n) {
      const auto& [sweeps, residual] = found[k].solves[n];
      const bool reached = residual <= target;
      table.row({all[k].scene, all[k].parameter, all[k].value, found[k].condition, std::string(names[n]),
                 sweeps, residual, reached ? "ok" : "not_converged", reached ? "" : "sweeps spent"});
      if (names[n] == "conjugate_gradients")
        conjugate.add(reached ? static_cast<double>(sweeps) / most_sweeps_of(found[k].condition)
                              : std::nan(""));
    }
  table.close();
  context.verdict(Basis::theory, "conditioning.conjugate_gradients",
                  "conjugate gradients reach the residual within Chebyshev's bound in every case",
                  "largest sweeps/bound", conjugate.value(), 1);
  context.advance("sweeps");
}

}  // namespace pbdcheck
