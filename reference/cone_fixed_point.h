// Coulomb's law as a sequence of convex problems (desaxce1998bipotential).
//
//   s <- mu |u_T(s)|,   u(s) the solution of the law `cone` with q_N + s in the place of q_N
// s is moved by a part of the way only where whole steps do not come closer. There may be no solution, or
// many.
#pragma once

#include <functional>

#include "cone_problem.h"

namespace pbd::reference {

struct ConvexSolver {
  std::function<ConeSolution(const ConeProblem&)> solve;  // the law `cone`
  /// Improves impulses under Coulomb's law, returns its iterations; may be empty.
  std::function<int(const ConeProblem&, Eigen::VectorXd&)> polish;
};

/// Certified by the natural residual of the law `coulomb`.
ConeSolution coulomb_by_fixed_point(const ConeProblem& problem, double tolerance, const ConvexSolver& solver,
                                    const ConeWork* work = nullptr);

}  // namespace pbd::reference
