// The matrices of damped oscillators against the closed forms without damping and against what defines them.
#include "oscillator_rules.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numbers>

using namespace pbd::reference;

namespace {

Discrete step_of(std::string_view integrator, double alpha, double h, double w, double retardation) {
  const auto& list = oscillator_rules();
  const auto found = std::find_if(list.begin(), list.end(), [&](const OscillatorRule& rule) {
    return rule.integrator == integrator && rule.alpha == alpha;
  });
  REQUIRE(found != list.end());
  return found->step(h, w, retardation);
}

/// An arc cosine near 1 keeps half of the digits.
void check_same(const Discrete& a, const Discrete& b) {
  CHECK(a.growth == Approx(b.growth).epsilon(1e-13));
  CHECK(a.phase == Approx(b.phase).epsilon(1e-9));
}

}  // namespace

TEST_CASE("rules without damping are the closed forms, implicit Euler with damping, too") {
  const double w = 2 * std::numbers::pi, h = GENERATE(0.1, 0.01, 0.001);
  check_same(step_of("implicit_euler", 0.55, h, w, 0), implicit_euler_oscillator(w * h));
  check_same(step_of("newmark", 0.5, h, w, 0), newmark_oscillator(w * h));
  check_same(step_of("midpoint", 0.55, h, w, 0), newmark_oscillator(w * h));
  check_same(step_of("bdf2", 0.55, h, w, 0), bdf2_oscillator(w * h));
  check_same(step_of("symplectic_euler", 0.55, h, w, 0), symplectic_euler_oscillator(w * h));
  check_same(step_of("implicit_euler", 0.55, h, w, 0.02),
             implicit_euler_damped_oscillator(w * h, w * 0.02 / 2));
}

TEST_CASE("generalised alpha leaves rho of infinitely fast oscillations") {
  CHECK(step_of("generalised_alpha", 0.55, 1, 1e9, 0).growth == Approx(0.8).epsilon(1e-4));
}

TEST_CASE("every rule has its order in decay and frequency of a damped oscillator") {
  const double w = 10, retardation = 0.01;  // k = 100 N/m, m = 1 kg, c = 1 N s/m
  const DampedSpring exact = damped_spring(100, 1, 1);
  for (const auto& rule : oscillator_rules()) {
    const auto error = [&](double h) {
      const Discrete step = rule.step(h, w, retardation);
      return std::hypot(std::log(step.growth) / h + exact.ratio * w, step.phase / h - exact.frequency);
    };
    INFO(rule.integrator << ", alpha " << rule.alpha);
    CHECK(std::log2(error(2e-3) / error(1e-3)) == Approx(rule.order).margin(0.05));
  }
}
