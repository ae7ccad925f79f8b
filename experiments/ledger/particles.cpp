// A falling particle and one on an orbit.
#include <cmath>

#include <fmt/format.h>

#include "closed_form.h"
#include "ledger/families.h"
#include "ledger/motion.h"

namespace pbdcheck::ledger {
namespace {

using namespace pbd;

void fall_row(Ledger& rows) {
  constexpr double h = 0.01, time = 1;
  rows.push_back({.id = "particle.fall_lag",
                  .statement = "a particle in free fall is ahead of the parabola by half a step's fall",
                  .quantity = "way beyond g t^2/2",
                  .unit = "m",
                  .formula = "g h t/2",
                  .scene = "free fall from rest, h = 0.01 s, t = 1 s",
                  .method = direct_method(),
                  .bound = {.absolute = 1e-12, .derivation = "implicit Euler's recurrence, rounding"},
                  .expected = [] { return reference::implicit_euler_fall_lag(9.81, h, time); },
                  .run =
                      [](const Method& method) {
                        Scene scene;
                        add_node(scene, Vec3::Zero(), 1);
                        scene.effects.emplace_back(Gravity{});
                        const State end = state_after(scene, method, h, std::lround(time / h));
                        return -end.x(2, 0) - 9.81 * time * time / 2;
                      }});
}

// ---- Kepler: a mass under a force that is handed to the solver before each step

constexpr double eccentricity = 0.6;

State orbit(const Method& method, double h, double time) {
  const auto start = reference::kepler_orbit(1, 1, eccentricity, 0);
  Scene scene;
  add_node(scene, Vec3(start.x, start.y, 0), 1, Vec3(start.vx, start.vy, 0));
  const auto pull = [](const State& state) {
    const Vec3 x = state.x.col(0);
    return ExternalForce{{0}, {-x / std::pow(x.norm(), 3)}};
  };
  scene.effects.emplace_back(pull(scene.initial));
  Motion motion(scene, method);
  for (auto k = std::lround(time / h); k > 0; --k) {
    motion.workspace.change(0, pull(motion.state));
    motion.advance(h);
  }
  return motion.state;
}

void orbit_rows(Ledger& rows) {
  constexpr double h = 1e-4;
  const LedgerRow row{
      .source = "landau1976mechanics",
      .scene = "Kepler orbit a = 1 m, mu = 1 m^3/s^2, e = 0.6, force set before each step, h = 1e-4 s",
      .method = direct_method("symplectic_euler")};
  LedgerRow momentum = row;
  momentum.id = "particle.kepler_momentum";
  momentum.statement = "symplectic Euler keeps the angular momentum of an orbit";
  momentum.quantity = "angular momentum after 3 s";
  momentum.unit = "m^2/s";
  momentum.formula = "sqrt(mu a (1 - e^2))";
  momentum.bound = {.absolute = 1e-11, .derivation = "kept exactly: rounding of 3e4 steps"};
  momentum.expected = [] { return std::sqrt(1 - eccentricity * eccentricity); };
  momentum.run = [](const Method& method) {
    const State end = orbit(method, h, 3);
    return end.x(0, 0) * end.v(1, 0) - end.x(1, 0) * end.v(0, 0);
  };
  rows.push_back(std::move(momentum));
  for (const double time : {1.0, 3.0})
    for (const int axis : {0, 1}) {
      LedgerRow place = row;
      place.id = fmt::format("particle.kepler_{}_{:g}", axis == 0 ? 'x' : 'y', time);
      place.statement = "a planet is where Kepler's equation says";
      place.quantity = fmt::format("{} after {:g} s", axis == 0 ? 'x' : 'y', time);
      place.unit = "m";
      place.formula = "E - e sin E = sqrt(mu/a^3) t, x = a (cos E - e), y = a sqrt(1 - e^2) sin E";
      // Its largest rate is v/r at the pericentre, 5 rad/s.
      place.bound = {
          .absolute = std::pow(5 * h, 2),
          .derivation = "order 1, h and h/2 extrapolated: (w h)^2 a, w the rate at the pericentre"};
      place.expected = [time, axis] {
        const auto at = reference::kepler_orbit(1, 1, eccentricity, time);
        return axis == 0 ? at.x : at.y;
      };
      place.run = [time, axis](const Method& method) {
        return extrapolated([&](double step) { return orbit(method, step, time).x(axis, 0); }, h, 1);
      };
      rows.push_back(std::move(place));
    }
}

}  // namespace

void particles(Ledger& rows) {
  fall_row(rows);
  orbit_rows(rows);
}

}  // namespace pbdcheck::ledger
