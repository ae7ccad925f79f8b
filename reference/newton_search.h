// Newton's method with line search for an objective and fixed multipliers.
//
//   dx = -(diag(inertia) + d2L/dx2)^-1 g,   x <- x + t dx
//
// with t = 1, 1/2, ... until the objective decreases sufficiently.
// An indefinite Hessian is replaced by the sum of the elements' positive semidefinite parts, and shifted by a
// multiple of the masses if that is singular. (nocedal2006numerical), sections 3.1, 3.4.
#pragma once

#include <chrono>

#include "kkt.h"
#include "primal_newton.h"

namespace pbd::reference {

/// Displacements below this share of the positions count as this share: rounding would dominate relative
/// measures.
inline constexpr double smallest_displacement = 1e-6;

/// Time spent, with pauses while observers run.
class Clock {
 public:
  double seconds() const { return spent_ + since(); }
  void pause() { spent_ += since(); }
  void resume() { start_ = now(); }

 private:
  using Time = std::chrono::steady_clock::time_point;
  static Time now() { return std::chrono::steady_clock::now(); }
  double since() const { return std::chrono::duration<double>(now() - start_).count(); }
  Time start_ = now();
  double spent_ = 0;
};

/// One minimisation: the objective, its factorisation and what happened so far.
struct Search {
  Objective objective;
  Assembly assembly;
  Vector u, start;  // unknowns now and at the beginning, m
  Multipliers multipliers;
  NewtonSettings settings;
  Clock clock;
  SparseCholesky factor;
  int iterations = 0, projected = 0, shifted = 0, rank = 0;
  double correction = 0;

  Search(Objective problem, const Vector& first, NewtonSettings s)
      : objective(std::move(problem)),
        assembly(*objective.model),
        u(first),
        start(first),
        settings(std::move(s)) {
    multipliers.gamma.setZero(objective.model->hard_rows);
  }

  const Model& model() const { return *objective.model; }
  double displacement() const;  // m
  void show(const Vector& unknowns);
};

/// Factorises diag(inertia) + hessian + shift M; false if that is not positive definite.
bool factorise(Search& search, const SparseMatrix& hessian, double shift);

/// Newton with fixed multipliers until the correction, relative to the displacement, is below the tolerance
/// or stalls at rounding. Returns whether it did.
bool descend(Search& search, double tolerance);

}  // namespace pbd::reference
