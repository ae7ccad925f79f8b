// What can solve a contact problem with friction, as `cone --relaxation` and the experiments name it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cones/cone_file.h"
#include "cones/cone_relaxations.h"

namespace pbdcheck {

/// That relaxations may take to solve a problem.
inline constexpr int most_sweeps = 200000;

/// Judges and rivals share no code with the solver; judges know no sweeps; rivals take W as it is.
enum class ConeSolverKind { judge, relaxation, rival };

struct ConeSolver {
  std::string name;
  std::vector<std::string> laws;
  std::function<pbd::reference::ConeSolution(const ConeTask&)> solve;
  ConeSolverKind kind;
};

/// Judges, the solver's relaxations, and rivals; the first is the default.
const std::vector<ConeSolver>& cone_solvers();
std::vector<std::string> cone_solver_names();

/// Names of all laws.
std::vector<std::string> cone_laws();

/// The solver of that name for that law. Throws SetupError naming those there are.
const ConeSolver& find_cone_solver(const std::string& name, const std::string& law);

/// Solves a problem whose W need not be symmetric, by problems with its symmetric part S: the rest K = W - S,
/// times the last impulses, moves to q. Ok within the tolerance for W as it is; else the best impulses there
/// were, and why. By the law cone it contracts if |S^-1/2 K S^-1/2| < 1, by the others if K is small enough.
/// It ends where five problems in a row bring no smaller residual.
pbd::reference::ConeSolution solve_as_given(const ConeSolver& solver, const ConeTask& task);

/// Solves the problem of a file, an unsymmetric one as it is given, but by the law cone by its symmetric part
/// alone: only that has a minimum. Measured for W as it is given, and ok if the residual of that is within
/// the tolerance, too, or W no more unsymmetric than its digits make it.
pbd::reference::ConeSolution solve_file(const ConeSolver& solver, const ConeFile& file,
                                        pbd::reference::FrictionLaw law, double tolerance);

pbd::reference::FrictionLaw friction_law(const std::string& name);

}  // namespace pbdcheck
