// Newton on the KKT system of an equality constrained minimum, to rounding.
//
//   [ H  J^T ] [  dx    ]   [ -g ]      H = d2L/dx2 with the current multipliers,  g = gradient without them
//   [ J   0  ] [ -gamma ] = [ -c ]
// solved by UMFPACK after scaling by masses. Where J is rank deficient (redundant constraints; SPQR finds the
// rank) the system is solved on independent rows, and gamma is the multiplier vector of least 2-norm with the
// same force J^T gamma.
#pragma once

#include <functional>

#include "assembly.h"
#include "judge.h"

namespace pbd::reference {

/// Objective of a step: 1/2 (u - target)^T diag(inertia) (u - target) - force.u + L(u).
struct Objective {
  const Model* model;
  Vector inertia;  // mass/h^2 per unknown, kg/s^2; zero for an equilibrium
  Vector target;   // y, m
  Points frame;    // positions of the nodes without unknowns at the end of the step

  double value(const Vector& u, const Multipliers& multipliers) const;
  /// Gradient and its magnitude (sum of absolute contributions) from the derivatives of L at u.
  Vector gradient(const Vector& u, const Derivatives& d) const;
  Vector magnitude(const Vector& u, const Derivatives& d) const;
  Points positions(const Vector& u) const { return scatter(*model, frame, u); }
};

/// Squared length of each hard row's gradient in the metric of inverse masses, 1/kg for lengths.
Vector inverse_effective_mass(const Model& model, const SparseMatrix& jacobian);

/// Indices of a largest set of rows that are independent by more than `threshold`, ascending.
std::vector<int> independent_rows(const Model& model, const SparseMatrix& jacobian, double threshold);

/// Multipliers of least 2-norm with the same force J^T gamma.
Vector least_norm(const SparseMatrix& jacobian, const Vector& gamma);

/// Sets the judgement's residual and infeasible from the derivatives of L at u with its multipliers.
void measure(const Objective& objective, const Derivatives& d, const Vector& u, double displacement,
             Judgement& judgement);

struct PolishSettings {
  double displacement;    // m, the length corrections and violations are compared with
  double rank_threshold;  // below it a row counts as dependent on others
};
struct Polish {
  bool converged = false;
  int iterations = 0;
  int rank = 0;
  double correction = 0;  // max |dx| of the last iteration / displacement
  double violation = 0;   // max |c| of all rows, dropped ones too / displacement
};
/// Improves u and gamma in place; on failure they are what they were. `shown` is called with u after each
/// iteration.
Polish polish(const Objective& objective, Assembly& assembly, const PolishSettings& settings, Vector& u,
              Vector& gamma, const std::function<void(const Vector&)>& shown);

}  // namespace pbd::reference
