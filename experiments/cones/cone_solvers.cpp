#include "cones/cone_solvers.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "cone_interior_point.h"
#include "cone_ipopt.h"
#include "error.h"
#include "harness/interrupt.h"
#include "linear/linear_names.h"
#include "rivals/siconos.h"
#include "scenes/choices.h"

namespace pbdcheck {

using namespace pbd::reference;

namespace {

ConeSolution solve_by_siconos(std::string_view name, const ConeTask& task) {
  const ConeProblem& given = task.problem;
  const pbd::rivals::ContactProblem problem{given.delassus, given.free_velocity, given.friction};
  if (!pbd::rivals::siconos_takes(problem))
    throw pbd::SetupError("W with " + std::string(name), "an entry by which Siconos ends the program",
                          "a positive diagonal, and entries from 1e-12 to 1e12 1/kg");
  auto answer = pbd::rivals::siconos(name, problem, task.tolerance, task.most_sweeps);
  throw_if_interrupted();
  ConeSolution found;
  found.impulse = std::move(answer.impulse);
  found.iterations = answer.iterations;
  found.seconds = answer.seconds;
  certify(task.problem, task.law, task.tolerance, found);
  return found;
}

}  // namespace

const std::vector<ConeSolver>& cone_solvers() {
  static const std::vector<ConeSolver> list = [] {
    const auto judge = [](auto solve) {
      return [=](const ConeTask& task) { return solve(task.problem, task.law, task.tolerance, nullptr); };
    };
    const std::vector<std::string> judged{"coulomb", "cone"};
    std::vector<ConeSolver> all{
        {"cone_interior_point", judged, judge(cone_interior_point), ConeSolverKind::judge},
        {"cone_ipopt", judged, judge(cone_ipopt), ConeSolverKind::judge}};
    for (const auto name : pbd::general_solver_names())
      all.push_back({std::string(name), cone_laws(),
                     [name](const ConeTask& task) { return relax_cone(name, task); },
                     ConeSolverKind::relaxation});
    for (const auto name : pbd::rivals::siconos_names)
      all.push_back({std::string(name),
                     {"coulomb"},
                     [name](const ConeTask& task) { return solve_by_siconos(name, task); },
                     ConeSolverKind::rival});
    return all;
  }();
  return list;
}

std::vector<std::string> cone_laws() {
  return {friction_law_names.begin(), friction_law_names.end()};
}

std::vector<std::string> cone_solver_names() {
  std::vector<std::string> names;
  for (const auto& solver : cone_solvers()) names.push_back(solver.name);
  return names;
}

const ConeSolver& find_cone_solver(const std::string& name, const std::string& law) {
  require_name("--law", law, cone_laws());
  require_name("--relaxation", name, cone_solver_names());
  const auto& solver = *std::find_if(cone_solvers().begin(), cone_solvers().end(),
                                     [&](const ConeSolver& each) { return each.name == name; });
  require_name("--law with --relaxation " + name, law, solver.laws);
  return solver;
}

ConeSolution solve_as_given(const ConeSolver& solver, const ConeTask& task) {
  constexpr int most_problems = 200;  // from 1 to 1e-9 by 0.9 each
  constexpr int patience = 5;
  constexpr double share = 0.1;  // of the tolerance, for each of them
  ConeProblem near = symmetric(task.problem);
  const SparseMatrix rest = task.problem.delassus - near.delassus;
  ConeSolution best;
  std::string why = "splitting W contracts too slowly";
  int sweeps = 0;
  double seconds = 0;
  for (int k = 0, improved = 0; k < most_problems && best.outcome != Outcome::ok; ++k) {
    throw_if_interrupted();
    ConeSolution next = solver.solve({near, task.law, share * task.tolerance, task.most_sweeps - sweeps});
    sweeps += next.iterations;
    seconds += next.seconds;
    const std::string missed = std::exchange(next.reason, "");
    certify(task.problem, task.law, task.tolerance, next);
    const bool better = k == 0 || next.measures.residual() < best.measures.residual();
    near.free_velocity = task.problem.free_velocity + rest * next.impulse;
    if (better) best = std::move(next), improved = k;
    if (!near.free_velocity.allFinite())
      why = "impulses are not finite";
    else if (!missed.empty() && !better)
      why = "W's symmetric part is not solved: " + missed;
    else if (k - improved >= patience)
      why = "splitting W does not contract";
    else if (solver.kind == ConeSolverKind::relaxation && sweeps >= task.most_sweeps)
      why = "no sweeps are left";
    else
      continue;
    break;
  }
  best.iterations = sweeps;
  best.seconds = seconds;
  if (best.outcome != Outcome::ok)
    best.reason =
        fmt::format("{} (asymmetry {:.2g}): {}", why, asymmetry(task.problem.delassus), best.reason);
  return best;
}

ConeSolution solve_file(const ConeSolver& solver, const ConeFile& file, FrictionLaw law, double tolerance) {
  if (solver.kind == ConeSolverKind::rival) return solver.solve({file.problem, law, tolerance, most_sweeps});
  if (law != FrictionLaw::cone && file.asymmetry > symmetric_within)
    return solve_as_given(solver, {file.problem, law, tolerance, most_sweeps});
  const ConeProblem symmetrised = symmetric(file.problem);
  const ConeSolution solved = solver.solve({symmetrised, law, tolerance, most_sweeps});
  ConeSolution found = solved;
  certify(file.problem, law, tolerance, found);
  // Numbers off by `rounding` of themselves are apart from their mirror's by twice that.
  if (solved.outcome != Outcome::ok || file.asymmetry <= 2 * file.rounding)
    found.outcome = solved.outcome, found.reason = solved.reason;
  else if (found.outcome != Outcome::ok)
    found.reason =
        fmt::format("W is unsymmetric by {:.2g}, and what minimises its symmetric part does not solve it: {}",
                    file.asymmetry, found.reason);
  return found;
}

FrictionLaw friction_law(const std::string& name) {
  require_name("--law", name, cone_laws());
  const auto& names = friction_law_names;
  return static_cast<FrictionLaw>(std::find(names.begin(), names.end(), name) - names.begin());
}

}  // namespace pbdcheck
