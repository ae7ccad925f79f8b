#include "circling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "dense.h"

namespace pbd::reference {
namespace {

using Complex = std::complex<double>;
using Quadratic = std::array<Complex, 3>;  // coefficients of 1, mu, mu^2
using Quartic = std::array<double, 5>;

/// (a + b mu)^2
Quadratic square(Complex a, Complex b) {
  return {a * a, 2.0 * a * b, b * b};
}

/// The product, of conjugates or summed with its conjugate: its coefficients are real.
Quartic product_of(const Quadratic& p, const Quadratic& q) {
  Quartic result{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) result[i + j] += (p[i] * q[j]).real();
  return result;
}

std::array<Complex, 4> roots(const Quartic& c) {
  Eigen::Matrix4d companion = Eigen::Matrix4d::Zero();
  companion.diagonal(-1).setOnes();
  for (int i = 0; i < 4; ++i) companion(i, 3) = -c[i] / c[4];
  const Eigen::VectorXcd found = eigenvalues(companion);
  return {found[0], found[1], found[2], found[3]};
}

}  // namespace

double circling_growth(double alpha, double turn, double stiffness) {
  const Complex e = std::polar(1.0, turn);
  const Complex rate = (e - 1.0) / (1 - alpha + alpha * e);
  const double tension = -(rate * rate).real();
  const Quadratic n = square(-1, e), d = square(1 - alpha, alpha * e);
  const Quadratic n_back = square(-1, std::conj(e)), d_back = square(1 - alpha, alpha * std::conj(e));
  const Quartic both = product_of(n, n_back), one = product_of(n, d_back), none = product_of(d, d_back);
  Quartic equation;  // over k + tension, so that a hard link is a limit
  const bool hard = std::isinf(stiffness);
  const double k = stiffness * stiffness;
  for (std::size_t i = 0; i < 5; ++i)
    equation[i] =
        hard ? one[i] + tension * none[i] : (both[i] + k * tension * none[i]) / (k + tension) + one[i];
  auto mu = roots(equation);
  std::sort(mu.begin(), mu.end(), [](Complex a, Complex b) { return std::abs(a - 1.0) < std::abs(b - 1.0); });
  return std::max(std::abs(mu[2]), std::abs(mu[3]));
}

double smallest_stable_alpha(double turn, double stiffness) {
  constexpr double rounding = 1e-9;  // of a double root
  const auto stable = [&](double alpha) { return circling_growth(alpha, turn, stiffness) <= 1 + rounding; };
  double low = 0.5, high = 1;
  if (stable(low)) return low;
  while (high - low > 1e-12) (stable((low + high) / 2) ? high : low) = (low + high) / 2;
  return high;
}

}  // namespace pbd::reference
