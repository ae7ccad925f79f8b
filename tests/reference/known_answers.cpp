// Formulas against stated values (to their digits) and against the same quantity by other means.
#include "known_answers.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "closed_form.h"
#include "closed_form_solids.h"
#include "numerics.h"

using namespace pbd::reference;

TEST_CASE("every known answer follows from its formula to the digits stated") {
  for (const KnownAnswer& row : known_answers()) {
    INFO(row.family << " " << row.statement << ": " << row.value);
    CHECK(std::abs(row.value - std::stod(row.stated)) <= 1.000001 * half_digit(row));
  }
}

TEST_CASE("known answers agree with quadrature, recurrences, ODEs and eigenvalues") {
  int checked = 0;
  for (const KnownAnswer& row : known_answers()) {
    if (!row.check) continue;
    INFO(row.family << " " << row.statement);
    CHECK(row.value == Approx(*row.check).epsilon(1e-10));
    ++checked;
  }
  CHECK(checked > 40);
}

TEST_CASE("the pendulum's elliptic functions solve its differential equation") {
  const double length = 1, g = 9.81, amplitude = 2;
  const auto slope = [&](double, const Eigen::VectorXd& y, Eigen::VectorXd& out) {
    out << y(1), -g / length * std::sin(y(0));
  };
  for (const double t : {0.1, 1.0, 5.0}) {
    const Angle exact = pendulum_motion(length, g, amplitude, t);
    const Eigen::VectorXd integrated = solve_ode(slope, Eigen::Vector2d(amplitude, 0), {t}).states.back();
    CHECK(exact.angle == Approx(integrated[0]).margin(1e-11));
    CHECK(exact.rate == Approx(integrated[1]).margin(1e-11));
  }
  CHECK(pendulum_motion(length, g, amplitude, pendulum_period(length, g, amplitude)).angle ==
        Approx(amplitude).epsilon(1e-12));
}

TEST_CASE("a hanging chain's modes solve (x y')' + lambda y = 0 with a free lower end") {
  // y(x) regular at the free end x = 0; by ODE from there, y vanishes at the support for a mode. Series
  // start: y = 1 - lambda x + ..., lambda = w^2/g.
  for (int mode = 1; mode <= 3; ++mode) {
    const double lambda =
        std::pow(2 * 3.14159265358979323846 * hanging_chain_frequency(mode, 1, 9.81), 2) / 9.81;
    const double start = 1e-6;
    const auto slope = [&](double t, const Eigen::VectorXd& y, Eigen::VectorXd& out) {
      out << y(1) / (start + t), -lambda * y(0);
    };
    const Eigen::Vector2d top(1 - lambda * start, -lambda * start);
    CHECK(solve_ode(slope, top, {1 - start}).states.back()(0) == Approx(0).margin(1e-9));
  }
}

TEST_CASE("the half space under a point load is in equilibrium, and its surface is free") {
  // (1 - 2 nu) lap(u) + grad(div(u)) = 0 within; shear and pressure vanish on the surface beside the load.
  constexpr double poisson = 0.3, h = 1e-3;
  const auto at = [](const Eigen::Vector3d& x) {
    const auto [inwards, outwards] = point_load_displacement(1, poisson, 1, x.z(), std::hypot(x.x(), x.y()));
    const Eigen::Vector2d across = outwards * x.head<2>().normalized();
    return Eigen::Vector3d(across.x(), across.y(), inwards);
  };
  const auto gradient = [&](const Eigen::Vector3d& x) {
    Eigen::Matrix3d du;
    for (int j = 0; j < 3; ++j)
      du.col(j) = (at(x + h * Eigen::Vector3d::Unit(j)) - at(x - h * Eigen::Vector3d::Unit(j))) / (2 * h);
    return du;
  };
  const Eigen::Vector3d within(0.5, -0.3, 0.7), on_surface(0.6, 0.8, 0);
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (int j = 0; j < 3; ++j) {
    const Eigen::Vector3d side = h * Eigen::Vector3d::Unit(j);
    force += (1 - 2 * poisson) * (at(within + side) - 2 * at(within) + at(within - side)) / (h * h);
    force[j] += (gradient(within + side).trace() - gradient(within - side).trace()) / (2 * h);
  }
  CHECK(force.norm() <= 10 * h * h);  // fourth derivatives of 1/rho, of order 10 at rho = 1
  const Eigen::Matrix3d du = gradient(on_surface);
  CHECK(std::abs(du(0, 2) + du(2, 0)) <= 10 * h * h);
  CHECK(std::abs(du(1, 2) + du(2, 1)) <= 10 * h * h);
  CHECK(std::abs((1 - 2 * poisson) * du(2, 2) + poisson * du.trace()) <= 10 * h * h);
}
