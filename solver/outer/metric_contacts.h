// Contacts that quasi_newton does not eliminate stay dual, with its metric P in the place of M:
//   u = J v + b + Sigma p obeys its law,   v = v_k - P^-1 gradient + P^-1 J^T p
// Of the rows that is a local problem: relative velocities u, and W = J P^-1 J^T between all contacts, for
// the linear solvers that take such: all but augmented_lagrangian. Contacts whose law asks for no impulse
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
  static constexpr int most_nodes = 5;

  /// Of one contact: its nodes of finite mass, and J turned as the metric is.
  struct Coupled {
    std::array<int, most_nodes> place{};  // in `inverse_`
    std::array<Eigen::Matrix3d, most_nodes> jacobian;
    int nodes = 0;
  };

  bool engage(Rows& rows, const std::vector<bool>& eliminated, const Points& v);
  void couple(Rows& rows, const std::vector<bool>& eliminated, const Metric& metric, const Points& v);
  void find_delassus(LocalContacts& block);

  MetricInverse inverse_;
  std::vector<int> places_;              // in `inverse_`, of all nodes that contacts touch
  std::vector<Eigen::Matrix3d> pushed_;  // P^-1 J^T of one contact, by places; 1/kg
  std::vector<Coupled> coupled_;
  Rows local_;
  std::vector<bool> engaged_;               // of all contacts: they take part
  Points velocity_, start_, force_, push_;  // m/s of the contacts, of the nodes; N s, m/s of the nodes
};

}  // namespace pbd
