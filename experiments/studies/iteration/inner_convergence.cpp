// How fast do the relaxations solve one linearised step? Errors of the velocity against a dense solution of
// the same rows; asymptotic rates against the spectral radii of the dense iteration matrices, in closed form
// for a free chain of N equal masses: Jacobi cos(pi/(N+1)), Gauss-Seidel its square.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "contraction.h"
#include "harness/rows_of_step.h"
#include "linear/linear_solver.h"
#include "scenes/standard.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;

struct CurveCase : Case {
  int sweeps;       // most of them
  int chain_links;  // of a free chain, whose rates are known in closed form; 0 otherwise
};

std::vector<CurveCase> curve_cases(bool full) {
  std::vector<CurveCase> all;
  const auto add = [&](std::string name, Scene scene, double h, int sweeps, int links = 0) {
    stir(scene);
    all.push_back({{std::move(name), std::move(scene), h}, sweeps, links});
  };
  for (const int links : {10, 20, 50, 100})
    add("chain" + std::to_string(links), chain(links, 1, true), 1.0 / 60, 10 * links * links, links);
  add("chain20 hanging, tip x100", chain(20, 100), 1.0 / 60, 20000);
  add("cloth20", cloth(20, true), 1.0 / 120, full ? 100000 : 20000);
  add("cantilever E=1e5 Pa", cantilever(4, {1e5, 0.3}, Strain::green), 1.0 / 60, 4000);
  add("cantilever E=1e6 Pa", cantilever(4, {1e6, 0.3}, Strain::green), 1.0 / 60, 20000);
  return all;
}

struct Run {
  std::vector<double> error;    // after each sweep
  std::vector<double> seconds;  // spent so far
  double factor = 1;            // omega that Jacobi used
};

constexpr double rounding_floor = 1e-13;

/// Sweeps until the error is at rounding or the case's number is spent. The error is taken outside the clock.
Run run_once(const CurveCase& each, const LinearStep& step, const Points& solved, std::string_view name) {
  LinearSolver any = make_linear_solver(name);
  Rows rows = step.rows;
  Points v = step.v_free;
  const double scale = (solved - step.v_free).norm();
  Run found;
  double spent = 0;
  std::visit(
      [&](auto& relaxation) {
        using Clock = std::chrono::steady_clock;
        auto start = Clock::now();
        relaxation.begin(rows, v, true);
        for (int k = 0; k < each.sweeps; ++k) {
          relaxation.sweep(rows, v, nullptr);
          spent += std::chrono::duration<double>(Clock::now() - start).count();
          found.error.push_back((v - solved).norm() / scale);
          found.seconds.push_back(spent);
          if (!(found.error.back() > rounding_floor)) break;
          if (name == "direct" && k >= 3) break;
          start = Clock::now();
        }
        if constexpr (requires { relaxation.factor(); }) found.factor = relaxation.factor();
      },
      any);
  return found;
}

/// Two runs after one that is thrown away, the smaller times kept.
Run timed(const CurveCase& each, const LinearStep& step, const Points& solved, std::string_view name) {
  run_once(each, step, solved, name);
  Run best = run_once(each, step, solved, name);
  const Run other = run_once(each, step, solved, name);
  for (std::size_t k = 0; k < best.seconds.size(); ++k)
    best.seconds[k] = std::min(best.seconds[k], other.seconds[k]);
  return best;
}

/// Contraction a sweep over the last half of the errors above 100 times rounding.
double rate_of_errors(const std::vector<double>& error) {
  std::size_t last = 0;
  while (last + 1 < error.size() && error[last + 1] > 100 * rounding_floor) ++last;
  if (last < 4) return std::nan("");
  const std::size_t first = last / 2;
  return std::pow(error[last] / error[first], 1.0 / static_cast<double>(last - first));
}

struct Prediction {
  double rate = std::nan("");
  std::string theory;
};

Prediction predict(const CurveCase& each, std::string_view relaxation,
                   const reference::RelaxationRates& dense) {
  if (relaxation == "direct") return {0, "exact"};
  if (relaxation == "conjugate_gradients") {
    const double root = std::sqrt(dense.condition);
    return {(root - 1) / (root + 1), "(sqrt(kappa) - 1)/(sqrt(kappa) + 1), Chebyshev's bound"};
  }
  if (relaxation == "nesterov_jacobi")
    return {1 - 1 / std::sqrt(dense.condition), "1 - 1/sqrt(kappa), Nesterov's bound"};
  const bool jacobi = relaxation == "jacobi";
  if (each.chain_links > 0) {
    const double radius = std::cos(std::numbers::pi / (each.chain_links + 1));
    return jacobi ? Prediction{radius, "cos(pi/(N+1))"} : Prediction{radius * radius, "cos(pi/(N+1))^2"};
  }
  return jacobi ? Prediction{dense.jacobi, "spectral radius of I - omega D^-1 N"}
                : Prediction{dense.gauss_seidel, "spectral radius of -(L + D)^-1 L^T"};
}

/// The errors that draw the curve: all of the first 100 sweeps, then about 1 % apart.
bool worth_drawing(std::size_t k, std::size_t count) {
  return k < 100 || k + 1 == count || k % std::max<std::size_t>(1, k / 100) == 0;
}

void run_case(Context& context, const CurveCase& each, Table& errors, Table& rates) {
  const LinearStep step = linear_step(each.scene, each.scene.initial, each.h);
  const Points solved = dense_solution(step);
  const auto names = general_solver_names();
  std::vector<Run> runs;
  double jacobi_factor = 1;
  for (const auto name : names) {
    runs.push_back(timed(each, step, solved, name));
    if (name == "jacobi") jacobi_factor = runs.back().factor;
  }
  const auto dense = reference::relaxation_rates(each.scene, each.scene.initial.x, each.h, jacobi_factor);
  for (std::size_t n = 0; n < names.size(); ++n) {
    const auto name = names[n];
    const Run& found = runs[n];
    const bool reached = found.error.back() < 1e-10;
    const std::string status = reached ? "ok" : "not_converged";
    const std::string reason = reached ? "" : "sweeps spent";
    for (std::size_t k = 0; k < found.error.size(); ++k)
      if (worth_drawing(k, found.error.size()))
        errors.row({each.name, std::string(name), static_cast<std::int64_t>(k + 1), found.seconds[k],
                    found.error[k], status, reason});
    const Prediction predicted = predict(each, name, dense);
    const double measured = name == "direct" ? found.error.front() : rate_of_errors(found.error);
    rates.row({each.name, std::string(name), predicted.rate, measured, predicted.theory, status, reason});
    if (each.chain_links > 0 && (name == "jacobi" || name == "gauss_seidel"))
      context.verdict(Basis::theory, "inner." + std::string(name) + "." + each.name,
                      "the asymptotic rate is the theory's", "|(1 - measured)/(1 - predicted) - 1|",
                      std::abs((1 - measured) / (1 - predicted.rate) - 1), 0.02);
  }
}

}  // namespace

std::vector<Case> inner_convergence_cases(bool full) {
  const auto all = curve_cases(full);
  return {all.begin(), all.end()};
}

void inner_convergence(Context& context) {
  const auto all = curve_cases(context.full());
  context.begin(std::ssize(all));
  Table errors =
      context.table("errors", {"scene", "relaxation", "sweep", "wall_s", "error", "status", "reason"});
  Table rates = context.table(
      "rates", {"scene", "relaxation", "predicted_rate", "measured_rate", "theory", "status", "reason"});
  for (const auto& each : all) {
    run_case(context, each, errors, rates);
    context.advance(each.name);
  }
  errors.close();
  rates.close();
}

}  // namespace pbdcheck
