// Contacts that quasi_newton does not eliminate stay dual, with its metric P in the place of M:
//   u = J v + b + Sigma p obeys its law,   v = v_k - P^-1 gradient + P^-1 J^T p
// Of the rows that is a local problem: the nodes that contacts touch, and the blocks of P^-1 between them,
// for the linear solvers that take such: all but augmented_lagrangian. Contacts whose law asks for no impulse
// take no part. Fixed points are the solutions of the step.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "linear/linear_solver.h"
#include "outer/metric_inverse.h"

namespace pbd {

class MetricContacts {
 public:
  /// Contacts that have an impulse, or whose law asks for one at v.
  static std::int64_t pressed(Rows& rows, const std::vector<bool>& eliminated, const Points& v);

  /// Solves the contacts' linear rows to the budget's residual (sqrt(J)); takes v (m/s) from v_k - P^-1
  /// gradient to where their impulses bring it. `fresh` as in `relax`. Returns the number of sweeps.
  std::int64_t solve(LinearSolver& solver, Rows& rows, const std::vector<bool>& eliminated, Metric& metric,
                     bool fresh, const InnerBudget& budget, Points& v);

 private:
  bool engage(Rows& rows, const std::vector<bool>& eliminated, const Points& v);
  void couple(Rows& rows, const std::vector<bool>& eliminated, const Metric& metric, const Points& v);
  void place_nodes(Rows& rows, const std::vector<bool>& eliminated, const Metric& metric);
  void find_response(LocalContacts& local) const;
  static void find_diagonal(LocalContacts& local);

  MetricInverse inverse_;
  std::vector<int> node_;                  // of the scene, that contacts touch, those of a part together
  std::vector<int> number_;                // in `node_`, of each of the scene's; -1 if none touches it
  std::vector<int> place_;                 // in `inverse_`, of each of `node_`
  std::vector<std::array<int, 3>> order_;  // scratch: part, place and node of the scene
  Rows local_;
  std::vector<bool> engaged_;               // of all contacts: they take part
  Points velocity_, start_, force_, push_;  // m/s of `node_`, turned, and of all nodes; N s; m/s
};

}  // namespace pbd
