// Gradient methods for the impulses of one step's contacts by the convex law: min F(p) = 1/2 p.W p + q.p over
// the cones |p_t| <= mu p_n, from p = 0. With one number a_i a contact, D = diag(a_i), W <= L D, F* the
// minimum and p* where it is:
//
//   p+ = P(y - (1/L) D^-1 (W y + q) + m (p - p_before))
//   ista           m = 0, y = p: Jacobi                   F - F* <= L |p*|_D^2 / (2 k)
//   fista          Nesterov's m, added to y as well       F - F* <= 2 L |p*|_D^2 / (k + 1)^2
//   mass_splitting ista in another metric, in which L = 1 (tonge2012mass)
//   power_law      y = p, m = (k/(K - 1))^0.6, 1/L = 0.1: what the paper's authors did before, for K sweeps
//                  (francu2014improved)
// The bounds are theorems 3.1 and 4.4 of beck2009fast. None of these is what the solver runs: its own
// `nesterov_jacobi` is fista with restart, its L estimated.
#pragma once

#include <array>

#include "studies/iteration/dual_trace.h"

namespace pbdcheck {

enum class Momentum { none, nesterov, restarted, power_law };

struct GradientMethod {
  std::string_view name;
  Momentum momentum;
  bool splits_mass = false;
};

inline constexpr std::array gradient_methods{
    GradientMethod{"ista", Momentum::none}, GradientMethod{"mass_splitting", Momentum::none, true},
    GradientMethod{"power_law", Momentum::power_law}, GradientMethod{"fista", Momentum::nesterov},
    GradientMethod{"fista_restarted", Momentum::restarted}};

struct Metric {
  Eigen::VectorXd diagonal;  // a_i
  double lipschitz;          // 1 over the step, the smallest L but for power_law
};

/// The solver's metric, trace(W_ii)/3, its L by dense eigenvalues; of split masses the largest eigenvalue of
/// sum_b n_b J_ib W_b J_ib^T, n_b the number of contacts at b.
Metric metric_of(const DualCase& of, const GradientMethod& method);

/// What theory allows after k sweeps, of F(0) - F*.
class DualBound {
 public:
  enum class Order { none, first, second };
  DualBound(const DualCase& of, const Metric& metric, Order order);
  double after(std::size_t k) const;  // NaN where there is no bound
  double worth() const;               // k where it falls to 1
  double lipschitz() const { return lipschitz_; }

 private:
  Order order_;
  double lipschitz_, length_;
};

class GradientSweeps {
 public:
  /// `budget` is the K of power_law.
  GradientSweeps(const pbd::reference::ConeProblem& problem, Momentum momentum, Metric metric, int budget);
  void sweep();
  const Eigen::VectorXd& impulse() const { return p_; }

 private:
  void next_momentum(bool uphill);

  const pbd::reference::ConeProblem& problem_;
  Momentum momentum_;
  Metric metric_;
  int budget_, sweep_ = 0;
  double theta_ = 1, m_ = 0;
  Eigen::VectorXd p_, before_;
};

}  // namespace pbdcheck
