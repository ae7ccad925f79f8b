#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "commands/commands.h"
#include "cones/cone_file.h"
#include "cones/cone_solvers.h"
#include "error.h"
#include "harness/progress.h"
#include "harness/provenance.h"

namespace pbdcheck {
namespace {

using pbd::reference::ConeSolution;

std::vector<double> list_of(const Eigen::VectorXd& numbers) {
  return {numbers.begin(), numbers.end()};
}

std::string status_of(const ConeSolution& solution) {
  return std::string(pbd::reference::outcome_names[static_cast<std::size_t>(solution.outcome)]);
}

/// Numbers that are not finite become null.
nlohmann::ordered_json solution_json(const ConeOptions& options, const ConeSolution& solution) {
  return {{"status", status_of(solution)},
          {"law", options.law},
          {"relaxation", options.relaxation},
          {"contacts", solution.impulse.size() / 3},
          {"natural_residual", solution.measures.natural_residual},
          {"gap", solution.measures.gap},
          {"feasibility", solution.measures.feasibility()},
          {"objective", solution.measures.objective},
          {"sweeps", solution.iterations},
          {"wall_s", solution.seconds},
          {"velocity", list_of(solution.velocity)},
          {"impulse", list_of(solution.impulse)}};
}

void print_solution(const ConeOptions& options, const ConeSolution& solution) {
  const auto& m = solution.measures;
  fmt::print("{}  law {}, relaxation {}, {} contacts\n", status_of(solution), options.law, options.relaxation,
             solution.impulse.size() / 3);
  fmt::print(
      "natural residual {:.3g}\ngap              {:.3g}\nfeasibility      {:.3g}\nobjective        {:.10g} "
      "J\n",
      m.natural_residual, m.gap, m.feasibility(), m.objective);
  fmt::print("sweeps           {}\nwall time        {:.3g} s\n", solution.iterations, solution.seconds);
  fmt::print("velocity, m/s (normal, tangent 1, tangent 2)\n");
  for (Eigen::Index i = 0; i + 2 < solution.velocity.size(); i += 3)
    fmt::print("{:24.16e} {:24.16e} {:24.16e}\n", solution.velocity(i), solution.velocity(i + 1),
               solution.velocity(i + 2));
}

}  // namespace

int cone(const ConeOptions& options) {
  if (!(options.tolerance > 0 && std::isfinite(options.tolerance)))
    throw pbd::SetupError("--tolerance", fmt::format("{}", options.tolerance), "a number > 0");
  std::error_code none;
  if (std::filesystem::equivalent(options.problem, options.output, none))
    throw pbd::SetupError("-o", options.output.string(), "another file than the problem");
  const ConeSolver& solver = find_cone_solver(options.relaxation, options.law);
  const ConeFile file = read_cone_file(options.problem);
  if (file.asymmetry > 1e-12)
    warn(fmt::format("{}: W is unsymmetric by {:.2g} of its size; solved with its symmetric part",
                     options.problem.string(), file.asymmetry));
  const ConeSolution solution =
      solver.solve({file.problem, friction_law(options.law), options.tolerance, most_sweeps});
  const bool solved = solution.outcome == pbd::reference::Outcome::ok;
  if (solved && !options.output.empty()) write_cone_file(options.output, file.problem, solution);
  if (options.json) {
    fmt::print("{}", json_text(solution_json(options, solution)));
  } else {
    fmt::print("{}\n", file.form);
    print_solution(options, solution);
  }
  if (solved) return exit_done;
  error_message(
      fmt::format("{}: {}{}", options.problem.string(), solution.reason,
                  options.output.empty() ? "" : "; " + options.output.string() + " is not written"));
  return exit_failed;
}

}  // namespace pbdcheck
