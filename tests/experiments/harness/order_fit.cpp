#include "harness/order_fit.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace pbdcheck;

TEST_CASE("the fitted order is the exponent of a power law, and that of the line of least squares") {
  const std::vector<double> h{0.1, 0.05, 0.025, 0.0125};
  std::vector<double> error;
  for (const double each : h) error.push_back(3 * std::pow(each, 1.5));
  CHECK(fitted_order(h, error) == Approx(1.5));
  // Logarithms to base 2 of 0, 1, 2, 3 and 0, 1, 1, 3: slope 4.5/5.
  CHECK(fitted_order({1, 2, 4, 8}, {1, 2, 2, 8}) == Approx(0.9));
}

TEST_CASE("there is no order of errors that vanish or are no numbers, nor of one level") {
  for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()})
    CHECK(std::isnan(fitted_order({1, 2}, {1, bad})));
  CHECK(std::isnan(fitted_order({1}, {1})));
  CHECK(std::isnan(fitted_order({}, {})));
  CHECK(std::isnan(fitted_order({1, 1}, {1, 2})));
}

TEST_CASE("errors are classified by whether they fall") {
  CHECK(behaviour_of({4, 2, 1}) == "converging");
  CHECK(behaviour_of({4, 5, 1}) == "oscillating");
  CHECK(behaviour_of({4, 2, 2}) == "oscillating");
  CHECK(behaviour_of({1, 0.5, 2}) == "diverging");
  CHECK(behaviour_of({1}) == "diverging");
  CHECK(behaviour_of({}) == "diverging");
  CHECK(behaviour_of({4, std::nan(""), 1}) == "diverging");
}

TEST_CASE("a cost that grows with another power than the first is off linear, in either direction") {
  const auto ruling = [](double power) {
    const std::vector<double> size{1e3, 1e4, 1e5};
    std::vector<double> time;
    for (const double n : size) time.push_back(1e-9 * std::pow(n, power));
    const std::vector<double> repeats(3, fitted_order(size, time));
    return Verdict{.id = "x", .measured = off_linear(repeats), .bound = off_linear_bound}.ruling();
  };
  CHECK(ruling(1) == Ruling::holds);
  CHECK(ruling(1.1) == Ruling::holds);
  for (const double power : {4.0 / 3, 2.0, 0.5, 0.0, -1.0}) CHECK(ruling(power) == Ruling::fails);
}
