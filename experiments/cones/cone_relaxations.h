// The solver's relaxations on a contact problem with friction, u = W r + q.
#pragma once

#include <string_view>

#include "cone_problem.h"
#include "rows/rows.h"

namespace pbdcheck {

/// The problem as rows of local contacts, impulses zero; their velocities are u.
pbd::Rows local_rows(const pbd::reference::ConeProblem& problem, pbd::reference::FrictionLaw law);

/// The contact problem of a step's rows: those of contacts, all with friction, and behind them all others,
/// as bounded rows whose bounds are infinite. W = J M^-1 J^T + Sigma, q = b + J v_free.
pbd::reference::ConeProblem cone_problem(const pbd::Rows& rows, const pbd::Points& v_free);

/// The rows' impulses, N s, in the order of that problem.
Eigen::VectorXd impulses_in_order(const pbd::Rows& rows);

/// v_free + M^-1 J^T impulse of those rows, m/s.
pbd::Points moved_by(const pbd::Rows& rows, pbd::Points v_free, const Eigen::VectorXd& impulse);

/// What the rows' impulses are to be: sweeps until the natural residual of their problem is within the
/// tolerance, or after `most_sweeps`; certified as every judge's solution is.
struct ConeTask {
  const pbd::reference::ConeProblem& problem;
  pbd::reference::FrictionLaw law;
  double tolerance;
  int most_sweeps;
};
pbd::reference::ConeSolution relax_cone(std::string_view relaxation, pbd::Rows rows, pbd::Points v_free,
                                        const ConeTask& task);

/// The same by rows of local contacts.
pbd::reference::ConeSolution relax_cone(std::string_view relaxation, const ConeTask& task);

}  // namespace pbdcheck
