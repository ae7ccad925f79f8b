#include "circling.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <limits>

using namespace pbd::reference;

namespace {

constexpr double hard = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("the trapezoidal rule multiplies a hard link's disturbance by the closed form") {
  // alpha = 1/2 makes the equation one in y = mu + 1/mu: y = 2, the circling, and y = 2 (c^2 - c - 1).
  for (const double turn : {0.01, 0.1, 0.5}) {
    const double c = std::cos(turn), y = 2 * (c * c - c - 1);
    const double mu = -y / 2 + std::sqrt(y * y / 4 - 1);
    CHECK(circling_growth(0.5, turn, hard) == Approx(mu).epsilon(1e-7));
    CHECK(mu == Approx(1 + turn).margin(turn * turn));
  }
}

TEST_CASE("slowly turning hard links multiply a disturbance by r (1 + theta)") {
  for (const double alpha : {0.5, 0.52, 0.6, 0.8})
    for (const double turn : {1e-3, 1e-2}) {
      const double r = (1 - alpha) / alpha;
      CHECK(circling_growth(alpha, turn, hard) == Approx(r * (1 + turn)).margin(2 * turn * turn));
    }
}

TEST_CASE("a link that hardly turns is the oscillator of the rule") {
  for (const double alpha : {0.5, 0.55, 1.0})
    for (const double stiffness : {0.5, 3.0, 100.0}) {
      const std::complex<double> z(0, stiffness);
      const double growth = std::abs((1.0 + (1 - alpha) * z) / (1.0 - alpha * z));
      CHECK(circling_growth(alpha, 1e-5, stiffness) == Approx(growth).epsilon(1e-4));
    }
}

TEST_CASE("the trapezoidal rule is unstable where h w_n tan(theta/2) > 2, at mu = -1") {
  for (const double turn : {0.05, 0.2}) {
    const double limit = 2 / std::tan(turn / 2);
    CHECK(circling_growth(0.5, turn, 0.98 * limit) == Approx(1).epsilon(1e-6));
    CHECK(circling_growth(0.5, turn, 1.02 * limit) > 1 + 1e-3);
    CHECK(circling_growth(0.5, turn, 1e9) == Approx(circling_growth(0.5, turn, hard)).epsilon(1e-6));
  }
}

TEST_CASE("the smallest stable alpha of a hard link is (1 + theta)/(2 + theta)") {
  for (const double turn : {1e-3, 1e-2, 0.1})
    CHECK(smallest_stable_alpha(turn, hard) == Approx((1 + turn) / (2 + turn)).margin(turn * turn));
  CHECK(smallest_stable_alpha(0.05, 10) == 0.5);
  CHECK(circling_growth(smallest_stable_alpha(0.1, hard) + 1e-6, 0.1, hard) < 1);
  CHECK(circling_growth(smallest_stable_alpha(0.1, hard) - 1e-6, 0.1, hard) > 1);
}
