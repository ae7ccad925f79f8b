#include "cone_fixed_point.h"

#include <chrono>

namespace pbd::reference {

using Eigen::VectorXd;

ConeSolution coulomb_by_fixed_point(const ConeProblem& problem, double tolerance, const ConvexSolver& solver,
                                    const ConeWork* work) {
  constexpr int most = 50, patience = 10;
  const auto begin = std::chrono::steady_clock::now();
  const auto residual = [&](const VectorXd& r) {
    return measure_cone(problem, FrictionLaw::coulomb, r).residual();
  };
  ConeProblem shifted = problem;
  VectorXd shift = VectorXd::Zero(problem.rows());
  ConeSolution best;
  best.impulse = shift;
  constexpr double rounding = 1e-14;
  double best_residual = residual(best.impulse), part = 1, previous = infinity;
  if (best_residual > rounding) best_residual = infinity;  // r = 0 is no solution
  int iterations = 0;
  for (int k = 0, improved = 0; k < most && k - improved < patience && best_residual > tolerance; ++k) {
    if (work != nullptr && work->spent()) break;
    shifted.free_velocity = problem.free_velocity + shift;
    ConeSolution found = solver.solve(shifted);
    iterations += found.iterations;
    const VectorXd u = problem.velocity(found.impulse);
    const VectorXd wanted = shifted_velocity(problem, FrictionLaw::coulomb, u) - u;
    if (solver.polish) iterations += solver.polish(problem, found.impulse);
    if (const double now = residual(found.impulse); now < best_residual) {
      if (now < best_residual / 2) improved = k;
      best_residual = now, best.impulse = found.impulse;
    }
    const double change = (wanted - shift).norm();
    if (change > 0.9 * previous) part = std::max(part / 2, 0.05);
    shift += part * (wanted - shift);
    previous = change;
  }
  best.iterations = iterations;
  certify(problem, FrictionLaw::coulomb, tolerance, best);
  best.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return best;
}

}  // namespace pbd::reference
