// The mechanisms of `joints` and their known answers.
#include <cmath>
#include <numbers>

#include "closed_form.h"
#include "numerics.h"
#include "scenes/mechanisms.h"
#include "studies/bodies/joints.h"

namespace pbdcheck {
namespace {

using namespace pbd;

double angle_of(const State& state, std::size_t body) {
  const auto& q = state.orientation[body];
  return 2 * std::atan2(q.z(), q.w());
}

Values bob(const State& state) {
  return {state.x(0, 1), state.x(1, 1)};
}

/// Top of the first leg.
Values first_top(const State& state) {
  const Vec3 top = Vec3(state.x.col(1)) + state.orientation[1] * Vec3(0.5, 0, 0);
  return {top.x(), top.y()};
}

/// The chain of four-bars moves as theta'' = -(G/I) cos theta with all legs parallel.
Values four_bars_end(int loops, double duration) {
  const double inertia = (loops + 1) / 3.0 + loops, weight = ((loops + 1) / 2.0 + loops) * 9.81;
  const auto solution = reference::solve_ode(
      [&](double, const Eigen::VectorXd& y, Eigen::VectorXd& slope) {
        slope[0] = y[1];
        slope[1] = -weight / inertia * std::cos(y[0]);
      },
      Eigen::Vector2d(std::numbers::pi / 2, -1), {duration});
  const double theta = solution.states[0][0];
  return {std::cos(theta), std::sin(theta)};
}

}  // namespace

Values squeezer_angles(const State& state) {
  const auto k = [&](std::size_t body) { return angle_of(state, body); };
  return {k(1), k(2) - k(1), k(3), k(4) - k(5), k(5), k(6) - k(7), k(7)};
}

Values slider_place(const State& state) {
  return {state.x(0, 3)};
}

std::vector<Mechanism> known_mechanisms(bool full) {
  const double swing = reference::pendulum_motion(1, 9.81, std::numbers::pi / 2, 10).angle;
  const double rate = 5, turned = rate * 2, crank = 0.2, rod = 0.5;
  // The squeezer at 0.03 s: the Test Set for IVP Solvers (mazzia2008test).
  const Values squeezed{15.81077119629904,  -15.75637105984298, 0.04082224013073101, -0.5347301163226948,
                        0.5244099658805304, 0.5347301163226948, 1.048080741042263};
  return {{"A01 pendulum",
           point_pendulum(),
           10,
           2000,
           full ? 8 : 5,
           {-std::sin(swing), -std::cos(swing)},
           1,
           bob,
           1},
          {"A02 four-bar chain", four_bars(2), 10, 2500, full ? 6 : 4, four_bars_end(2, 10), 1, first_top, 3},
          {"A03 squeezer", andrews_squeezer(), 0.03, 600, full ? 6 : 4, squeezed, 15.81077119629904,
           squeezer_angles},
          {"slider-crank",
           slider_crank(rate),
           2,
           400,
           2,
           {crank * std::cos(turned) + std::sqrt(rod * rod - std::pow(crank * std::sin(turned), 2))},
           crank,
           slider_place}};
}

}  // namespace pbdcheck
