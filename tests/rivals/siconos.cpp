// Siconos' solvers as the rivals have them, on problems whose answer is a closed form.
#include "rivals/siconos.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace pbd::rivals;

/// Siconos keeps some bytes of each solve: no leak of ours.
extern "C" const char* __lsan_default_suppressions();   // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier)
  return "leak:libsiconos_numerics";
}

using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

VectorXd impulse_of(std::string_view name, const Eigen::Matrix3d& delassus, const Vector3d& q, double mu) {
  const Eigen::SparseMatrix<double> w = delassus.sparseView();
  const VectorXd friction = VectorXd::Constant(1, mu);
  return siconos(name, {w, q, friction}, 1e-10, 10000).impulse;
}

}  // namespace

TEST_CASE("Siconos' solvers bring a mass point to rest, let it slide, and let it go") {
  constexpr double mass = 2, mu = 0.5;  // kg
  const Eigen::Matrix3d w = Eigen::Matrix3d::Identity() / mass;
  for (const auto name : siconos_names) {
    INFO(name);
    const Vector3d sticks(-1, 0.3, 0), slides(-1, 0.6, 0.8), leaves(1, 1, 0);  // normal, tangents; m/s
    CHECK((impulse_of(name, w, sticks, mu) + mass * sticks).norm() < 1e-8);
    CHECK((impulse_of(name, w, slides, mu) - mass * Vector3d(1, -mu * 0.6, -mu * 0.8)).norm() < 1e-8);
    CHECK(impulse_of(name, w, leaves, mu).norm() < 1e-8);
  }
}

TEST_CASE("Siconos' solvers are not given what ends the program") {
  for (const double entry : {0.0, -1.0, 1e90, std::nan("")}) {
    Eigen::Matrix3d w = Eigen::Matrix3d::Identity();
    w(0, 0) = entry;
    const VectorXd q = Vector3d(-1, 0, 0), friction = VectorXd::Constant(1, 0.5);
    const Eigen::SparseMatrix<double> delassus = w.sparseView();
    CHECK_FALSE(siconos_takes({delassus, q, friction}));
    for (const auto name : siconos_names) CHECK(impulse_of(name, w, q, 0.5).isZero(0));
  }
}

TEST_CASE("Siconos' solvers take no contact, and nsgs and nsn_ac a W that is not symmetric") {
  Eigen::Matrix3d w = Eigen::Matrix3d::Identity();
  w(1, 0) = 0.2;
  const Vector3d q(-1, 0.1, 0), r = -w.inverse() * q;  // sticks: |r_T| = 0.3 of r_N = 1
  for (const auto name : {siconos_names[0], siconos_names[1]})
    CHECK((impulse_of(name, w, q, 0.5) - r).norm() < 1e-8);
  for (const auto name : siconos_names)
    CHECK(siconos(name, {Eigen::SparseMatrix<double>(0, 0), VectorXd(0), VectorXd(0)}, 1e-8, 10)
              .impulse.size() == 0);
}
