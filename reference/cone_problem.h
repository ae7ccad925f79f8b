// One step's contact problem with friction, and how far impulses are from its solution.
//
//   u = W r + q,   K_i = {|r_T| <= mu_i r_N},   K_i* = {u_N >= mu_i |u_T|},   K the product over contacts
//   cone      K contains r, perpendicular to u in K*                  (the minimum of 1/2 r.W r + q.r over K)
//   coulomb   the same with u~ = u + mu |u_T| e_N in the place of u   (Signorini and Coulomb; de Saxce)
//   box       as coulomb by |.|_inf in K and |.|_1 in K* and u~: a bound for each tangent; no judge solves it
// Contact i owns rows 3 i .. 3 i + 2: normal, tangent 1, tangent 2. Behind them stand scalar rows whose
// impulses have bounds (limits of joints, motors of limited force), of either law
//   p in [l, h],   u >= 0 where p = l,  u <= 0 where p = h,  else u = 0      (p = P(p - u), P clamps)
// and K is the product of all of these sets; r in N s, u in m/s, of bounded rows in the units of their value.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>

#include "judge.h"
#include "sparse.h"

namespace pbd::reference {

enum class FrictionLaw { cone, coulomb, box };
inline constexpr std::array<std::string_view, 3> friction_law_names{"cone", "coulomb", "box"};

struct ConeProblem {
  SparseMatrix delassus;             // W, 1/kg; for the judges symmetric positive semidefinite
  Eigen::VectorXd free_velocity;     // q, m/s
  Eigen::VectorXd friction;          // mu of each contact
  Eigen::VectorXd lower{}, upper{};  // l <= 0 <= h of each bounded row, N s; may be infinite

  int contacts() const { return static_cast<int>(friction.size()); }
  int bounded() const { return static_cast<int>(lower.size()); }
  int rows() const { return 3 * contacts() + bounded(); }
  Eigen::VectorXd velocity(const Eigen::VectorXd& impulse) const;  // u, m/s
};

/// The point of {|t| <= mu n} nearest to (n, t).
Eigen::Vector3d project_on_cone(const Eigen::Vector3d& point, double mu);
/// The point of {|t_1|, |t_2| <= mu n} nearest to (n, t).
Eigen::Vector3d project_on_pyramid(const Eigen::Vector3d& point, double mu);
/// The derivative of `project_on_cone`, or one of its limits where it jumps; symmetric, eigenvalues in [0,
/// 1].
Eigen::Matrix3d cone_projection_derivative(const Eigen::Vector3d& point, double mu);

/// u for the law cone, u + mu |u_T| e_N for coulomb, for box with |u_T|_1.
Eigen::VectorXd shifted_velocity(const ConeProblem& problem, FrictionLaw law,
                                 const Eigen::VectorXd& velocity);

/// r - P_K(r - u~): zero exactly at solutions. Impulses and velocities are added as numbers in kg m/s and
/// m/s.
Eigen::VectorXd natural_map(const ConeProblem& problem, FrictionLaw law, const Eigen::VectorXd& impulse);

/// What impulses are worth, whoever found them.
struct ConeMeasures {
  double natural_residual = 0;   // |r - P_K(r - u~)| / |q|; not divided where q = 0
  double scaled_residual = 0;    // the same of the equilibrated problem, which no choice of units changes
  double gap = 0;                // |r.u~| / (|r.W r| + |r.q|): 0 for 0/0
  double impulse_distance = 0;   // of r from K over |r|
  double velocity_distance = 0;  // of u~ from K* over |q|; of bounded rows from what no bound ends
  double objective = 0;          // 1/2 r.W r + q.r, J
  double rounding = 0;           // what rounding of r and W r alone may make of residual()

  double residual() const { return std::max(natural_residual, scaled_residual); }
  double feasibility() const { return std::max(impulse_distance, velocity_distance); }
};
ConeMeasures measure_cone(const ConeProblem& problem, FrictionLaw law, const Eigen::VectorXd& impulse);

/// The problem in r' = r / s, u' = s u with one s > 0 a contact, or bounded row, that makes the mean diagonal
/// of W's blocks 1.
struct EquilibratedCone {
  ConeProblem problem;
  Eigen::VectorXd scale;  // s, one per row
};
EquilibratedCone equilibrate(const ConeProblem& problem);

/// How much more may be spent on cone problems. One unit is an iteration, a factorisation in the main, of a
/// dense problem of 100 rows or a smaller one; others are of as many as the power 3/2 of the entries of W
/// says, so that dense ones go by the cube of their rows. `poll` is called before each one; what it throws
/// ends the work.
struct ConeWork {
  static constexpr double unit_entries = 1e4;

  double left = infinity;
  std::function<void()> poll{};

  bool spent() const { return left <= 0; }
  /// Takes so many iterations; false if there was nothing left.
  bool spend(double entries, double iterations = 1) {
    if (poll) poll();
    if (spent()) return false;
    left -= iterations * std::pow(std::max(1.0, entries / unit_entries), 1.5);
    return true;
  }
};

/// Impulses somebody found; `outcome` is ok exactly if residual() and velocity_distance are within the
/// tolerance asked for, and all is finite. (The second follows from the first but for rounding.)
struct ConeSolution {
  Eigen::VectorXd impulse, velocity;  // r, N s; u = W r + q, m/s (not u~)
  ConeMeasures measures;
  Outcome outcome = Outcome::not_converged;
  std::string reason;  // empty if ok
  int iterations = 0;
  double seconds = 0;
};

/// Completes a solution from its impulses: velocity, measures, outcome and reason.
void certify(const ConeProblem& problem, FrictionLaw law, double tolerance, ConeSolution& solution);

}  // namespace pbd::reference
