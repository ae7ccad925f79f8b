// Linear (inner) solvers improve impulses p and velocities v of linear rows, keeping v - W J^T p as it is:
//   J v + b + Sigma p = 0  (unit of the rows per second).
// They see rows and laws only. `begin` is called after each linearisation, `sweep` visits every row once.
// What else a solver does are its `further_sweeps`: power iterations, Gauss-Seidel's, factorisations.
#pragma once

#include <variant>

#include "linear/augmented_lagrangian.h"
#include "linear/conjugate_gradients.h"
#include "linear/direct.h"
#include "linear/gauss_seidel.h"
#include "linear/jacobi.h"
#include "linear/ldlt.h"
#include "linear/linear_names.h"
#include "linear/nesterov_jacobi.h"
#include "linear/semismooth_newton.h"

namespace pbd {

using LinearSolver = std::variant<GaussSeidel, ColouredGaussSeidel, Jacobi, NesterovJacobi,
                                  ConjugateGradients, Direct, Ldlt, SemismoothNewton, AugmentedLagrangian>;

/// When to end the sweeps: residual <= max(absolute, relative * that of the first sweep), or after
/// max_sweeps, further ones not counted.
struct InnerBudget {
  int max_sweeps = 1;
  double relative = 0;
  double absolute = 0;  // sqrt(J)
};

/// Sweeps until the budget's end; `fresh`: nothing of the solver's earlier iterates in this step counts;
/// returns the number of sweeps, further ones included. Adds the first sweep's seconds of each block to
/// `first_sweep` unless it is null.
std::int64_t relax(LinearSolver& solver, Rows& rows, Points& v, bool fresh, const InnerBudget& budget,
                   BlockSeconds first_sweep);

/// What was learnt of earlier rows counts no more.
void forget(LinearSolver& solver);

/// Which part of a composed solver worked last; of the others their name.
std::string_view part(const LinearSolver& solver);

/// A fresh one by name (SetupError if unknown).
LinearSolver make_linear_solver(std::string_view name);

/// Throws SetupError if the solver cannot solve such rows at all, or not with this law of their contacts.
void require_solvable(const LinearSolver& solver, const Rows& rows, Friction law);

}  // namespace pbd
