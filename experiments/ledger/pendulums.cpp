// Pendulums of points and rods: periods by elliptic integrals, frequencies, what implicit Euler leaves of
// their energy.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "closed_form.h"
#include "closed_form_bodies.h"
#include "ledger/families.h"
#include "ledger/motion.h"
#include "scenes/mechanisms.h"
#include "scenes/standard.h"

namespace pbdcheck::ledger {
namespace {

using namespace pbd;
using std::numbers::pi;

constexpr double fine_h = 1e-3;  // s

/// Order 2 and h, h/2 extrapolated leave a term of order (w h)^3, w the largest rate.
LedgerBound extrapolated_bound(double rate) {
  return {.relative = std::pow(rate * fine_h, 3),
          .derivation = fmt::format("order 2, h = {:g} s and h/2 extrapolated: (w h)^3, w = {:.3g} rad/s",
                                    fine_h, rate)};
}

/// Four times the time of the first passage of column 1 through x = 0.
double period_by_quarter(const Scene& scene, const Method& method, double latest) {
  return 4 * extrapolated(
                 [&](double h) {
                   return passage(
                       scene, method, h, [](const State& state) { return state.x(0, 1); },
                       [](const State& state) { return state.v(0, 1); }, latest);
                 },
                 fine_h, 2);
}

void period_rows(Ledger& rows) {
  for (const double degrees : {5, 30, 60, 90, 120, 150, 170, 179}) {
    const double amplitude = degrees * pi / 180;
    const double fastest = 2 * std::sqrt(gravity) * std::sin(amplitude / 2);
    const double slowest = std::sqrt(gravity);
    rows.push_back(
        {.id = fmt::format("pendulum.period_{:g}", degrees),
         .statement = "a pendulum's period is that of the elliptic integral",
         .quantity = "period",
         .unit = "s",
         .formula = "4 sqrt(l/g) K(sin(amplitude/2))",
         .source = "landau1976mechanics",
         .scene = fmt::format("1 kg on a hard link of 1 m from {:g} degrees at rest", degrees),
         .method = direct_method("bdf2"),
         .bound = extrapolated_bound(std::max(fastest, slowest)),
         .expected = [=] { return reference::pendulum_period(1, gravity, amplitude); },
         .run = [=](const Method& method) { return period_by_quarter(pendulum(amplitude, 0), method, 3); }});
  }
  rows.push_back(
      {.id = "pendulum.rod_period",
       .statement = "a uniform rod about its end swings as a pendulum of two thirds of its length",
       .quantity = "period",
       .unit = "s",
       .formula = "4 sqrt(2 l/(3 g)) K(sin(amplitude/2))",
       .source = "landau1976mechanics",
       .scene = "rod of 1 m on a ball joint from 90 degrees at rest",
       .method = direct_method("bdf2"),
       .bound = extrapolated_bound(std::sqrt(3 * gravity)),
       .expected =
           [] { return reference::pendulum_period(reference::rod_pendulum_length(1), gravity, pi / 2); },
       .run = [](const Method& method) { return period_by_quarter(rod_chain(1), method, 1); }});
}

void conical_row(Ledger& rows) {
  constexpr double angle = pi / 6;
  const double rate = std::sqrt(gravity / std::cos(angle));
  rows.push_back({.id = "pendulum.conical_period",
                  .statement = "a pendulum on a circle takes as long as one of the circle's depth",
                  .quantity = "period",
                  .unit = "s",
                  .formula = "2 pi sqrt(l cos(angle)/g)",
                  .source = "landau1976mechanics",
                  .scene = "1 kg on a hard link of 1 m, on a circle at 30 degrees",
                  .method = direct_method("bdf2"),
                  .bound = extrapolated_bound(rate),
                  .expected = [] { return reference::conical_pendulum_period(1, gravity, angle); },
                  .run =
                      [rate](const Method& method) {
                        Scene scene = pendulum(angle, 0);
                        scene.initial.v.col(1) = Vec3(0, rate * std::sin(angle), 0);
                        return extrapolated(
                            [&](double h) {
                              return passage(
                                  scene, method, h, [](const State& state) { return state.x(1, 1); },
                                  [](const State& state) { return state.v(1, 1); }, 3, 2);
                            },
                            fine_h, 2);
                      }});
}

/// Turned about the y axis through the origin.
Scene turned(Scene scene, double angle) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, Vec3::UnitY()));
  scene.initial.x = (turn.toRotationMatrix() * scene.initial.x).eval();
  for (auto& orientation : scene.initial.orientation) orientation = turn * orientation;
  return scene;
}

void falling_rod_row(Ledger& rows) {
  constexpr double tilt = pi / 180;
  rows.push_back(
      {.id = "pendulum.falling_rod",
       .statement = "a rod that falls over has its fall's energy when it lies",
       .quantity = "rate at the horizontal",
       .unit = "rad/s",
       .formula = "sqrt(3 g cos(tilt)/l)",
       .source = "landau1976mechanics",
       .scene = "rod of 1 m on a ball joint, let go 1 degree from upright",
       .method = direct_method("bdf2"),
       .bound = extrapolated_bound(std::sqrt(3 * gravity)),
       .expected = [] { return reference::falling_rod_rate(1, gravity) * std::sqrt(std::cos(tilt)); },
       .run =
           [](const Method& method) {
             const Scene scene = turned(rod_chain(1), -(pi / 2 - tilt));
             return extrapolated(
                 [&](double h) {
                   Motion motion(scene, method);
                   while (motion.state.x(2, 1) > 0) motion.advance(h);
                   // The rest of the way back to the horizontal, by the energy of the rod.
                   const double rate = motion.state.spin.col(1).norm();
                   return std::sqrt(rate * rate + 6 * gravity * motion.state.x(2, 1));
                 },
                 fine_h, 2);
           }});
}

void decay_rows(Ledger& rows) {
  constexpr double amplitude = 1e-4;  // rad
  for (const int rate : {60, 600}) {
    const double h = 1.0 / rate, turns = 10 * 2 * pi / std::sqrt(gravity) / h;
    rows.push_back(
        {.id = fmt::format("pendulum.energy_left_{}", rate),
         .statement = "implicit Euler leaves of a small pendulum's energy what linear theory says",
         .quantity = "energy after ten periods over that at the start",
         .unit = "1",
         .formula = "(1 + g h^2/l)^(-steps)",
         .scene = fmt::format("1 kg on a hard link of 1 m from 1e-4 rad, h = 1/{} s", rate),
         .method = direct_method(),
         .bound = {.relative = 1e-6,
                   .derivation = "amplitude 1e-4 rad: its square times the logarithm; tolerance"},
         .expected =
             [=] {
               const double growth = reference::implicit_euler_oscillator(std::sqrt(gravity) * h).growth;
               return std::pow(growth, 2 * turns);
             },
         .run =
             [=](const Method& method) {
               const auto steps = std::lround(turns);
               const State end = state_after(pendulum(amplitude, 0), method, h, steps);
               const double left = std::pow(end.x(0, 1), 2) + std::pow(end.v(0, 1), 2) / gravity;
               return std::pow(left / std::pow(std::sin(amplitude), 2), turns / static_cast<double>(steps));
             }});
  }
}

/// Let go at rest with both bobs turned from the vertical (rad).
Scene double_pendulum(double upper, double lower) {
  Scene scene;
  const Vec3 first(std::sin(upper), 0, -std::cos(upper)), second(std::sin(lower), 0, -std::cos(lower));
  add_node(scene, Vec3::Zero(), infinity);
  add_node(scene, first, 1);
  add_node(scene, first + second, 1);
  scene.effects.emplace_back(Gravity{});
  scene.effects.emplace_back(Distance{.node = {{0, 1}, {1, 2}}, .rest_length = {1, 1}, .compliance = {0, 0}});
  return scene;
}

void double_rows(Ledger& rows) {
  constexpr double amplitude = 1e-4, h = 0.02;
  for (const int mode : {1, 2})
    rows.push_back(
        {.id = fmt::format("pendulum.double_mode_{}", mode),
         .statement = "a small double pendulum swings in its modes",
         .quantity = mode == 1 ? "slow frequency" : "fast frequency",
         .unit = "Hz",
         .formula = "sqrt((2 -+ sqrt(2)) g/l)/(2 pi)",
         .source = "landau1976mechanics",
         .scene = "two bobs of 1 kg on hard links of 1 m, in the mode's shape, 1e-4 rad, h = 0.02 s",
         .method = direct_method(),
         .bound = {.relative = 1e-6,
                   .derivation = "implicit Euler's phase undone; the square of the amplitude, "
                                 "over the phase of a step, squared"},
         .expected =
             [mode] {
               return reference::double_pendulum_frequency({1, 1, 1, 1}, gravity, mode);
             },
         .run =
             [mode](const Method& method) {
               const double other = (mode == 1 ? 1 : -1) * std::numbers::sqrt2 * amplitude;
               return slowest_frequency(double_pendulum(amplitude, other), method, h, 2,
                                        [](const State& state) { return state.x(0, 1); });
             }});
}

void benchmark_rows(Ledger& rows) {
  for (const double time : {1.0, 2.0, 5.0})
    rows.push_back(
        {.id = fmt::format("pendulum.iftomm_a01_{:g}", time),
         .statement = "IFToMM's benchmark A01 is where the elliptic functions say",
         .quantity = fmt::format("x after {:g} s", time),
         .unit = "m",
         .formula = "x = -sin(angle), sin(angle/2) = k sn(K - t sqrt(g/l))",
         .source = "gonzalez2006benchmarking",
         .scene = "1 kg on a hard rod of 1 m from (-1, 0)",
         .method = direct_method("bdf2"),
         .bound = {.absolute = std::pow(std::sqrt(2 * gravity) * fine_h, 3) * time * std::sqrt(2 * gravity),
                   .derivation = "order 2, h = 0.001 s and h/2 extrapolated: (w h)^3 w t l"},
         .expected = [time] { return -std::sin(reference::pendulum_motion(1, gravity, pi / 2, time).angle); },
         .run =
             [time](const Method& method) {
               return extrapolated(
                   [&](double h) {
                     return state_after(point_pendulum(), method, h, std::lround(time / h)).x(0, 1);
                   },
                   fine_h, 2);
             }});
}

}  // namespace

void pendulums(Ledger& rows) {
  period_rows(rows);
  conical_row(rows);
  falling_rod_row(rows);
  decay_rows(rows);
  double_rows(rows);
  benchmark_rows(rows);
}

}  // namespace pbdcheck::ledger
