#include "cones/cone_solvers.h"

#include <algorithm>

#include "cone_interior_point.h"
#include "cone_ipopt.h"
#include "error.h"
#include "linear/linear_names.h"
#include "scenes/choices.h"

namespace pbdcheck {

using namespace pbd::reference;

const std::vector<ConeSolver>& cone_solvers() {
  static const std::vector<ConeSolver> list = [] {
    const auto judge = [](auto solve) {
      return [=](const ConeTask& task) { return solve(task.problem, task.law, task.tolerance); };
    };
    const std::vector<std::string> judged{"coulomb", "cone"};
    std::vector<ConeSolver> all{{"cone_interior_point", judged, judge(cone_interior_point), true},
                                {"cone_ipopt", judged, judge(cone_ipopt), true}};
    for (const auto name : pbd::general_solver_names())
      all.push_back({std::string(name), cone_laws(),
                     [name](const ConeTask& task) { return relax_cone(name, task); }, false});
    return all;
  }();
  return list;
}

std::vector<std::string> cone_laws() {
  return {friction_law_names.begin(), friction_law_names.end()};
}

const ConeSolver& find_cone_solver(const std::string& name, const std::string& law) {
  require_name("--law", law, cone_laws());
  std::vector<std::string> names;
  for (const auto& solver : cone_solvers()) names.push_back(solver.name);
  require_name("--relaxation", name, names);
  const auto& solver = *std::find_if(cone_solvers().begin(), cone_solvers().end(),
                                     [&](const ConeSolver& each) { return each.name == name; });
  require_name("--law with --relaxation " + name, law, solver.laws);
  return solver;
}

ConeSolution solve_as_given(const ConeSolver& solver, const ConeTask& task) {
  constexpr int most_problems = 50;
  constexpr double share = 0.1;  // of the tolerance, for each of them
  ConeProblem near = symmetric(task.problem);
  const SparseMatrix rest = task.problem.delassus - near.delassus;
  ConeSolution found;
  int sweeps = 0;
  double seconds = 0;
  for (int k = 0; k < most_problems; ++k) {
    const ConeSolution next =
        solver.solve({near, task.law, share * task.tolerance, task.most_sweeps - sweeps});
    sweeps += next.iterations;
    seconds += next.seconds;
    found.impulse = next.impulse;
    found.reason.clear();
    certify(task.problem, task.law, task.tolerance, found);
    if (found.outcome == Outcome::ok || (!solver.judge && sweeps >= task.most_sweeps)) break;
    near.free_velocity = task.problem.free_velocity + rest * found.impulse;
  }
  found.iterations = sweeps;
  found.seconds = seconds;
  return found;
}

FrictionLaw friction_law(const std::string& name) {
  require_name("--law", name, cone_laws());
  const auto& names = friction_law_names;
  return static_cast<FrictionLaw>(std::find(names.begin(), names.end(), name) - names.begin());
}

}  // namespace pbdcheck
