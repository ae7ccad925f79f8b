#include "oscillator_rules.h"

#include <cmath>
#include <complex>

#include "dense.h"

namespace pbd::reference {
namespace {

using Pole = std::complex<double>;

/// h mu.
Pole exponent(double h, double w, double retardation) {
  const double decay = w * w * retardation / 2;
  return h * Pole(-decay, std::sqrt(w * w - decay * decay));
}

Discrete discrete(Pole root) {
  return {std::abs(root), std::abs(std::arg(root))};
}

/// y' = y + h ((1 - theta) f + theta f').
Discrete theta_rule(double theta, double h, double w, double retardation) {
  const Pole z = exponent(h, w, retardation);
  return discrete((1.0 + (1 - theta) * z) / (1.0 - theta * z));
}
Discrete implicit_euler(double h, double w, double retardation) {
  return theta_rule(1, h, w, retardation);
}
Discrete trapezoidal(double h, double w, double retardation) {
  return theta_rule(0.5, h, w, retardation);
}
Discrete damped_trapezoidal(double h, double w, double retardation) {
  return theta_rule(0.55, h, w, retardation);
}

Discrete bdf2(double h, double w, double retardation) {
  const Pole z = exponent(h, w, retardation);
  return discrete((2.0 + std::sqrt(1.0 + 2.0 * z)) / (3.0 - 2.0 * z));
}

/// v' = v - h w^2 (q + T v), q' = q + h v': the matrix has the determinant 1 - h w^2 T.
Discrete symplectic_euler(double h, double w, double retardation) {
  const double square = 1 - h * w * w * retardation;
  return {std::sqrt(square), std::acos((1 + square - h * h * w * w) / (2 * std::sqrt(square)))};
}

/// Newmark's q and v with (1-alpha_m) a' + alpha_m a = (1-alpha_f) q'' + alpha_f q''_l.
Discrete generalised_alpha(double h, double w, double retardation) {
  const double rho = 0.8, alpha_m = (2 * rho - 1) / (rho + 1), alpha_f = rho / (rho + 1);
  const double gamma = 0.5 - alpha_m + alpha_f, beta = std::pow(1 - alpha_m + alpha_f, 2) / 4;
  Eigen::Matrix3d matrix;  // of (q, v, a)
  for (int k = 0; k < 3; ++k) {
    const double q = k == 0, v = k == 1, a = k == 2;
    const double q_next = q + h * v + h * h * (0.5 - beta) * a, v_next = v + h * (1 - gamma) * a;
    const double pull = (1 - alpha_f) * w * w;
    const double a_next =
        -(alpha_m * a + alpha_f * w * w * (q + retardation * v) + pull * (q_next + retardation * v_next)) /
        (1 - alpha_m + pull * (beta * h * h + retardation * gamma * h));
    matrix.col(k) << q_next + h * h * beta * a_next, v_next + h * gamma * a_next, a_next;
  }
  const Eigen::VectorXcd roots = eigenvalues(matrix);
  Eigen::Index largest = 0;
  roots.cwiseAbs().maxCoeff(&largest);
  return discrete(roots[largest]);
}

}  // namespace

const std::vector<OscillatorRule>& oscillator_rules() {
  static const std::vector<OscillatorRule> list{{"implicit_euler", 0.55, 1, implicit_euler},
                                                {"newmark", 1, 1, implicit_euler},
                                                {"newmark", 0.5, 2, trapezoidal},
                                                {"newmark", 0.55, 1, damped_trapezoidal},
                                                {"generalised_alpha", 0.55, 2, generalised_alpha, 60},
                                                {"midpoint", 0.55, 2, trapezoidal},
                                                {"bdf2", 0.55, 2, bdf2, 40},
                                                {"symplectic_euler", 0.55, 1, symplectic_euler}};
  return list;
}

}  // namespace pbd::reference
