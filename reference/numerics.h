// Roots, quadrature and ordinary differential equations by GSL.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <stdexcept>
#include <vector>

namespace pbd::reference {

/// Root of f in [low, high] by Brent's method to rounding. Throws std::runtime_error if f has the same sign
/// at both ends.
double find_root(const std::function<double(double)>& f, double low, double high);
/// Integral over [low, high] to about 1e-12 relative (adaptive Gauss-Kronrod). Throws std::runtime_error if
/// not reached.
double integrate(const std::function<double(double)>& f, double low, double high);

/// Sets `slope` to f(t, y), of the size of y; where it is not finite the step is tried again with half its
/// length.
using Slope = std::function<void(double t, const Eigen::VectorXd& y, Eigen::VectorXd& slope)>;

struct OdeSettings {
  double tolerance = 1e-13;  // of a step's error in y_i, over 1 + |y_i|
  long max_evaluations = 10'000'000;
  std::function<void()> poll{};  // called at each evaluation; what it throws ends the integration
};
struct OdeSolution {
  std::vector<Eigen::VectorXd> states;  // one per time asked
  long evaluations = 0;                 // of f, 13 a step
};
/// The solution cannot be continued, or not within the evaluations allowed.
struct OdeFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// y' = f(t, y) from y(0), at increasing times >= 0, by the method 8(7) of (prince1981high) with step
/// control. Throws OdeFailure, and std::invalid_argument for other times.
OdeSolution solve_ode(const Slope& f, Eigen::VectorXd y, const std::vector<double>& times,
                      const OdeSettings& settings = {});

}  // namespace pbd::reference
