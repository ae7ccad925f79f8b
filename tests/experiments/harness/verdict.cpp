// What numbers beside their bounds come to.
#include "harness/verdict.h"

#include <catch2/catch.hpp>
#include <limits>

#include "harness/measure.h"

using namespace pbdcheck;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

Ruling ruling(const Measured& measured, double bound, Basis basis = Basis::code) {
  return Verdict{.basis = basis, .measured = measured, .bound = bound}.ruling();
}

}  // namespace

TEST_CASE(
    "a size from 0 to its bound holds; beyond it, negative or no number it fails, whatever it rests on") {
  CHECK(ruling(1, 1) == Ruling::holds);
  CHECK(ruling(0, 0) == Ruling::holds);
  for (const double wrong :
       {1.0000001, 700.0, -1e-9, -1.0, not_a_number, std::numeric_limits<double>::infinity()}) {
    CAPTURE(wrong);
    for (const Basis basis : {Basis::code, Basis::theory, Basis::paper, Basis::robustness})
      CHECK(ruling(wrong, 1, basis) == Ruling::fails);
    CHECK(ruling(wrong, 1, Basis::goal) == Ruling::missed);
  }
  CHECK(ruling(1, not_a_number) == Ruling::fails);
}

TEST_CASE("repeats on both sides of the bound decide nothing, repeats beyond it fail") {
  CHECK(ruling(Measured({0.9, 1.1, 1.3}), 1.5) == Ruling::holds);
  CHECK(ruling(Measured({0.9, 1.1, 1.3}), 1.2) == Ruling::not_decided);
  CHECK(ruling(Measured({0.9, 1.1, 1.3}), 1) == Ruling::not_decided);
  CHECK(ruling(Measured({0.9, 1.1, 1.3}), 0.8) == Ruling::fails);
  CHECK(ruling(Measured({0.9, 1.1, 1.3}), 0.8, Basis::goal) == Ruling::missed);
  CHECK(ruling(Measured({0.9, not_a_number}), 1.2) == Ruling::fails);
  CHECK(ruling(Measured({-0.1, 0.1}), 1) == Ruling::fails);
  CHECK(ruling(Measured(std::vector<double>{}), 1) == Ruling::fails);
}

TEST_CASE("repeats are told by their median and range") {
  const Measured odd({3, 1, 2}), even({4, 1, 2, 3});
  CHECK((odd.value == 2 && odd.low == 1 && odd.high == 3));
  CHECK((even.value == 2.5 && even.low == 1 && even.high == 4));
}

TEST_CASE("what does not hold says why") {
  const auto reason = [](const Measured& measured) {
    return Verdict{.measured = measured, .bound = 1}.reason();
  };
  CHECK(reason(1).empty());
  CHECK(reason(2) == "2 > 1");
  CHECK(reason(Measured({1.5, 2, 4})) == "2 > 1, spread from 1.5 to 4");
  CHECK(reason(-2) == "a size is not negative");
  CHECK(reason(not_a_number) == "no number was measured");
  CHECK(reason(Measured({0.5, 2})) == "spread: repeats from 0.5 to 2, bound 1");
}

TEST_CASE("the worst is the largest and says whose it is, and the first that is no number spoils it") {
  Worst worst;
  CHECK(std::isnan(worst.value()));
  worst.add(1, "a");
  worst.add(3, "b");
  worst.add(2, "c");
  CHECK((worst.value() == 3 && worst.owner() == "b"));
  worst.add(not_a_number, "d");
  worst.add(5, "e");
  CHECK((std::isnan(worst.value()) && worst.owner() == "d"));

  WorstSpread spread;
  spread.add(Measured({1, 2, 3}), "a");
  spread.add(Measured({1.5, 1.6, 4}), "b");
  CHECK((spread.value().low == 1.5 && spread.value().value == 2 && spread.value().high == 4));
  CHECK(spread.owner() == "a");
}

TEST_CASE("an error is measured against the reference, not against itself") {
  const pbd::Points start = pbd::Points::Zero(3, 2), reference = pbd::Points::Ones(3, 2);
  CHECK(relative_error(1.5 * reference, reference, start) == Approx(0.5));
  CHECK(relative_error(start, reference, start) == Approx(1));
  CHECK(relative_error(reference, reference, start) == 0);
}
