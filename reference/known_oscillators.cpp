#include <array>
#include <cmath>
#include <complex>
#include <functional>

#include "closed_form.h"
#include "known_answers_rows.h"

namespace pbd::reference::known {
namespace {

/// Ratio |z_n| and mean phase of the recurrence z_{n+1} = next(z_n, z_{n-1}) after n steps, from z_0 = 1 and
/// z_1.
std::complex<double> recurrence(
    const std::function<std::complex<double>(std::complex<double>, std::complex<double>)>& next,
    std::complex<double> first, int steps) {
  std::complex<double> before = 1, now = first;
  for (int n = 1; n < steps; ++n) {
    const auto after = next(now, before);
    before = now;
    now = after;
  }
  return now;
}

/// Amplitude left after t = 1 for w = 2 pi, by stepping z' = i w z.
double stepped_implicit_euler(double h) {
  const std::complex<double> i(0, 1);
  const auto step = [&](std::complex<double> z, std::complex<double>) {
    return z / (1.0 - i * 2.0 * pi * h);
  };
  return std::abs(recurrence(step, step(1, 0), static_cast<int>(std::lround(1 / h))));
}
double stepped_bdf2(double h) {
  const std::complex<double> i(0, 1);
  const Discrete exact = bdf2_oscillator(2 * pi * h);
  const auto step = [&](std::complex<double> z, std::complex<double> old) {
    return (4.0 * z - old) / (3.0 - 4.0 * i * pi * h);
  };
  return std::abs(
      recurrence(step, std::polar(exact.growth, exact.phase), static_cast<int>(std::lround(1 / h))));
}

/// Growth and phase of the damped compliant constraint's step: det = growth^2 and trace = 2 growth cos(phase)
/// of its map of (x, v).
Discrete stepped_damped(double stiffness, double mass, double damping, double h) {
  const double compliance = 1 / stiffness, tau = damping / stiffness;
  const auto step = [&](double x, double v) {
    // m (v1 - v)/h = gamma with (1 + tau/h) (x + h v1) - tau/h x + A gamma = 0.
    const double after = (compliance * mass / h * v - x) / (compliance * mass / h + h + tau);
    return std::array{x + h * after, after};
  };
  const auto from_x = step(1, 0), from_v = step(0, 1);
  const double growth = std::sqrt(from_x[0] * from_v[1] - from_x[1] * from_v[0]);
  return {growth, std::acos((from_x[0] + from_v[1]) / (2 * growth))};
}

void damped(Rows& rows) {
  const DampedSpring exact = damped_spring(100, 1, 1);
  const double w = 10;
  struct Case {
    double h;
    const char *amplitude, *frequency, *decrement;
  };
  for (const Case& c : {Case{0.1, "0.0244851927021", "0.761340005543", "3.06536363536"},
                        Case{0.01, "0.371527882127", "0.991768530115", "0.628066906671"},
                        Case{0.001, "0.577124236178", "0.999467051685", "0.346002208868"}}) {
    const Discrete step = implicit_euler_damped_oscillator(w * c.h, exact.ratio);
    const Discrete stepped = stepped_damped(100, 1, 1, c.h);
    const std::string of = " of x'' = -100 x - x', h = " + number(c.h) + " s";
    rows.push_back({"damped_oscillator", "implicit Euler: amplitude after 1 s" + of, "1",
                    std::pow(step.growth, 1 / c.h), c.amplitude, std::pow(stepped.growth, 1 / c.h)});
    rows.push_back({"damped_oscillator", "implicit Euler: frequency ratio" + of, "1",
                    step.phase / (c.h * exact.frequency), c.frequency,
                    stepped.phase / (c.h * exact.frequency)});
    rows.push_back({"damped_oscillator", "implicit Euler: logarithmic decrement" + of, "1",
                    logarithmic_decrement(step), c.decrement, logarithmic_decrement(stepped)});
  }
}

}  // namespace

void oscillators(Rows& rows) {
  struct Case {
    double h;
    const char *euler, *euler_frequency, *newmark, *bdf2, *bdf2_frequency, *symplectic;
  };
  for (const Case& c :
       {Case{0.1, "0.189437059", "0.892830768", "0.968921916", "0.821788215", "0.907391070", "1.01722594"},
        Case{0.01, "0.821187780", "0.998687161", "0.999671208", "0.999614244", "0.998691004", "1.00016457"},
        Case{0.001, "0.980454716", "0.999986841", "0.999996710", "0.999999610", "0.999986841",
             "1.00000164"}}) {
    const double wh = 2 * pi * c.h;
    const std::string at = " of x'' = -(2 pi)^2 x, h = " + number(c.h) + " s";
    const Discrete euler = implicit_euler_oscillator(wh), bdf2 = bdf2_oscillator(wh);
    rows.push_back({"oscillator", "implicit Euler: amplitude after 1 s" + at, "1",
                    std::pow(euler.growth, 1 / c.h), c.euler, stepped_implicit_euler(c.h)});
    rows.push_back({"oscillator", "implicit Euler: frequency ratio" + at, "1", euler.phase / wh,
                    c.euler_frequency, std::arg(1.0 / std::complex<double>(1, -wh)) / wh});
    // Newmark's (Cayley's) map z -> (1 + i wh/2)/(1 - i wh/2) z; symplectic Euler: trace 2 - (wh)^2 = 2
    // cos(phase).
    rows.push_back({"oscillator", "Newmark (1/4, 1/2): frequency ratio" + at, "1",
                    newmark_oscillator(wh).phase / wh, c.newmark,
                    std::arg(std::complex<double>(1, wh / 2) / std::complex<double>(1, -wh / 2)) / wh});
    rows.push_back({"oscillator", "BDF2: amplitude after 1 s" + at, "1", std::pow(bdf2.growth, 1 / c.h),
                    c.bdf2, stepped_bdf2(c.h)});
    rows.push_back({"oscillator", "BDF2: frequency ratio" + at, "1", bdf2.phase / wh, c.bdf2_frequency, {}});
    rows.push_back({"oscillator", "symplectic Euler: frequency ratio" + at, "1",
                    symplectic_euler_oscillator(wh).phase / wh, c.symplectic,
                    std::acos(1 - wh * wh / 2) / wh});
  }
  damped(rows);
}

}  // namespace pbd::reference::known
