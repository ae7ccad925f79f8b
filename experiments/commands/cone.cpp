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

/// What was asked, and what was found.
struct Answer {
  const ConeOptions& options;
  const ConeFile& file;
  const std::vector<std::string>& warnings;
  ConeSolution solution;      // of W as it is given
  double symmetric_residual;  // natural, of W's symmetric part
};

std::vector<std::string> warnings_of(const ConeFile& file, bool convex) {
  std::vector<std::string> all = file.warnings;
  if (!file.semidefinite) all.emplace_back("W's symmetric part is not positive semidefinite");
  if (file.asymmetry > symmetric_within)
    all.push_back(fmt::format("W is unsymmetric by {:.2g} of its size; {}", file.asymmetry,
                              convex ? "solved with its symmetric part" : "solved as it is"));
  return all;
}

/// Numbers that are not finite become null.
nlohmann::ordered_json solution_json(const Answer& answer) {
  const auto& [options, file, warnings, solution, symmetric_residual] = answer;
  return {{"status", status_of(solution)},
          {"reason", solution.reason},
          {"form", file.form},
          {"warnings", warnings},
          {"law", options.law},
          {"relaxation", options.relaxation},
          {"contacts", solution.impulse.size() / 3},
          {"natural_residual", solution.measures.natural_residual},
          {"natural_residual_symmetric", symmetric_residual},
          {"asymmetry", file.asymmetry},
          {"gap", solution.measures.gap},
          {"feasibility", solution.measures.feasibility()},
          {"objective", solution.measures.objective},
          {"sweeps", solution.iterations},
          {"wall_s", solution.seconds},
          {"velocity", list_of(solution.velocity)},
          {"impulse", list_of(solution.impulse)}};
}

void print_solution(const Answer& answer) {
  const auto& [options, file, warnings, solution, symmetric_residual] = answer;
  const auto& m = solution.measures;
  fmt::print("{}  law {}, relaxation {}, {} contacts\n", status_of(solution), options.law, options.relaxation,
             solution.impulse.size() / 3);
  fmt::print("{}\n", file.form);
  if (file.asymmetry > 0)
    fmt::print("W unsymmetric by {:.3g} of its size; natural residual of its symmetric part {:.3g}\n",
               file.asymmetry, symmetric_residual);
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
  const auto law = friction_law(options.law);
  const bool convex = law == pbd::reference::FrictionLaw::cone;
  const std::string name = options.problem.string();
  if (!file.semidefinite && convex)
    throw pbd::SetupError(name, "W whose symmetric part is not positive semidefinite",
                          "for the law cone a Delassus matrix, H^T M^-1 H");
  const auto warnings = warnings_of(file, convex);
  for (const auto& warning : warnings) warn(fmt::format("{}: {}", name, warning));
  const ConeSolution solution = solve_file(solver, file, law, options.tolerance);
  const Answer answer{options, file, warnings, solution,
                      measure_cone(symmetric(file.problem), law, solution.impulse).natural_residual};
  const bool solved = solution.outcome == pbd::reference::Outcome::ok;
  if (solved && !options.output.empty()) write_cone_file(options.output, file.problem, solution);
  if (options.json) {
    fmt::print("{}", json_text(solution_json(answer)));
  } else {
    print_solution(answer);
  }
  if (solved) return exit_done;
  error_message(
      fmt::format("{}: {}{}", name, solution.reason,
                  options.output.empty() ? "" : "; " + options.output.string() + " is not written"));
  return exit_failed;
}

}  // namespace pbdcheck
