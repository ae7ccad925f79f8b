// Smoothed laws of friction: their derivatives, what they become without smoothing, and single values.
#include "linear/smoothed_law.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "rows/laws.h"

using namespace pbd;

namespace {

const Eigen::Matrix3d delassus = (Eigen::Matrix3d() << 3, 0.2, -0.1, 0.2, 2, 0.3, -0.1, 0.3, 1.5).finished();

Vec3 missed(bool coulomb, double mu, double e, const Vec3& p, const Vec3& r) {
  return smoothed_law(coulomb, mu, delassus, e, p, r).missed;
}

}  // namespace

TEST_CASE("a smoothed law's derivatives are those of its values") {
  const bool coulomb = GENERATE(true, false);
  const double mu = GENERATE(0.0, 0.3, 1.5), e = GENERATE(0.1, 2.0);
  const Vec3 p(0.7, -0.4, 0.2), r(-0.3, 0.9, 0.5);
  const SmoothedLaw law = smoothed_law(coulomb, mu, delassus, e, p, r);
  constexpr double step = 1e-5, accuracy = 1e-9;  // the third derivatives are some 1/e^2
  for (int k = 0; k < 3; ++k) {
    const Vec3 d = step * Vec3::Unit(k);
    const Vec3 by_p = (missed(coulomb, mu, e, p + d, r) - missed(coulomb, mu, e, p - d, r)) / (2 * step);
    const Vec3 by_r = (missed(coulomb, mu, e, p, r + d) - missed(coulomb, mu, e, p, r - d)) / (2 * step);
    CHECK((law.by_p.col(k) - by_p).norm() <= accuracy / (e * e));
    CHECK((law.by_r.col(k) - by_r).norm() <= accuracy / (e * e));
  }
}

TEST_CASE("a law is missed by nothing but its smoothing where it holds") {
  constexpr double mu = 0.5, e = 1e-8;
  const Vec3 none = Vec3::Zero();
  constexpr double most = 2.001 * e;  // by |z_t| and by the eigenvalues, each e at most; and rounding
  for (const bool coulomb : {true, false}) {
    CHECK(missed(coulomb, mu, e, {1, 0.3, -0.2}, none).norm() <= most);  // it sticks
    CHECK(missed(coulomb, mu, e, none, {2, 0.3, -0.2}).norm() <= most);  // it opens
    CHECK(missed(coulomb, 0, e, {1, 0, 0}, {0, 4, 5}).norm() <= most);   // without friction
    CHECK(missed(coulomb, mu, e, {1, 0.6, 0}, none).norm() > 0.01);      // outside of the cone
    CHECK(missed(coulomb, mu, e, none, {-0.1, 0, 0}).norm() > 0.01);     // it closes
  }
  // Sliding along -x at 2 m/s.
  CHECK(missed(true, mu, e, {1, mu, 0}, {0, -2, 0}).norm() <= most);
  CHECK(missed(false, mu, e, {1, mu, 0}, {2 * mu, -2, 0}).norm() <= most);
  CHECK(missed(false, mu, e, {1, mu, 0}, {0, -2, 0}).norm() > 0.1);
}

TEST_CASE("where nothing acts and moves, smoothing asks for its own size") {
  constexpr double e = 0.3;
  CHECK((missed(false, 0.7, e, Vec3::Zero(), Vec3::Zero()) + e * Vec3::UnitX()).norm() <= 1e-15);
  const double golden = (std::sqrt(5.0) - 1) / 2;  // the eigenvalues of -e: (-e + sqrt(e^2 + 4 e^2))/2
  CHECK((missed(true, 0.7, e, Vec3::Zero(), Vec3::Zero()) + golden * e * Vec3::UnitX()).norm() <= 1e-15);
}
