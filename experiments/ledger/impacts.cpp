// Bodies that strike: bounces, cradles, stacked balls, oblique impacts.
#include <cmath>

#include <fmt/format.h>

#include "closed_form_contact.h"
#include "ledger/families.h"
#include "ledger/motion.h"
#include "scenes/contacts.h"

namespace pbdcheck::ledger {
namespace {

using namespace pbd;

constexpr double radius = 0.1;  // m, of balls

/// The trapezoidal rule keeps the energy of free flight.
Method flight_method() {
  Method method = direct_method("newmark");
  method.alpha = 0.5;
  return method;
}

Placing at_height(double height, const Vec3& velocity = Vec3::Zero()) {
  return {Vec3(0, 0, height), Eigen::Quaterniond::Identity(), velocity};
}

void bounce_rows(Ledger& rows) {
  constexpr double h = 1e-4, height = 1;
  const double speed = std::sqrt(2 * gravity * height);
  for (const double e : {0.5, 0.8, 1.0})
    rows.push_back({.id = fmt::format("impact.bounce_{:g}", e),
                    .statement = "a ball rises again to the square of its restitution",
                    .quantity = "height of the first bounce",
                    .unit = "m",
                    .formula = "e^2 h",
                    .scene = fmt::format("ball dropped from 1 m, restitution {:g}, h = 1e-4 s", e),
                    .method = flight_method(),
                    .bound = {.absolute = (1 - e * e) * speed * h + 1e-9,
                              .derivation = "a step turns the speed: (1 - e^2) v h"},
                    .expected = [e] { return e * e * height; },
                    .run =
                        [e](const Method& method) {
                          BodyScene build({.friction = 0, .restitution = e});
                          build.ground();
                          build.ball(radius, 1, at_height(radius + height));
                          Motion motion(build.finish(), method);
                          do motion.advance(h);
                          while (motion.state.v(2, 1) < 0);
                          const double v = motion.state.v(2, 1);
                          return motion.state.x(2, 1) - radius + v * v / (2 * gravity);
                        }});
}

/// Exact impacts one after the other: velocities do not depend on the step.
const LedgerBound exact_impacts{
    .absolute = 1e-9, .relative = 1e-9, .derivation = "impacts are exact; tolerance"};

void sequence_rows(Ledger& rows) {
  for (const double ratio : {2.0, 10.0, 100.0, 1e4})
    rows.push_back({.id = fmt::format("impact.stacked_{:g}", ratio),
                    .statement = "of two balls that land together the upper rises higher than it fell",
                    .quantity = "height over that of the fall",
                    .unit = "1",
                    .formula = "((3 M - m)/(M + m))^2",
                    .scene = fmt::format("elastic balls, masses {:g}:1, at 1 m/s, apart, no gravity", ratio),
                    .method = flight_method(),
                    .bound = exact_impacts,
                    .expected = [ratio] { return std::pow((3 * ratio - 1) / (ratio + 1), 2); },
                    .run =
                        [ratio](const Method& method) {
                          BodyScene build({.friction = 0, .restitution = 1}, 0);
                          build.ground();
                          build.ball(radius, ratio, at_height(radius + 0.05, Vec3(0, 0, -1)));
                          build.ball(radius, 1, at_height(3 * radius + 0.1, Vec3(0, 0, -1)));
                          return std::pow(state_after(build.finish(), method, 0.01, 40).v(2, 2), 2);
                        }});
  for (const int ball : {0, 4})
    rows.push_back({.id = fmt::format("impact.cradle_{}", ball == 0 ? "first" : "last"),
                    .statement = "in Newton's cradle one ball comes and one goes",
                    .quantity = ball == 0 ? "speed of the first ball" : "speed of the last ball",
                    .unit = "m/s",
                    .formula = ball == 0 ? "0" : "v",
                    .scene = "five elastic balls, the first at 1 m/s, gaps of 0.03 m",
                    .method = flight_method(),
                    .bound = exact_impacts,
                    .expected = [ball] { return ball == 0 ? 0.0 : 1.0; },
                    .run =
                        [ball](const Method& method) {
                          BodyScene build({.friction = 0, .restitution = 1}, 0);
                          for (int k = 0; k < 5; ++k)
                            build.ball(radius, 1,
                                       {Vec3(k * (2 * radius + 0.03), 0, 0), Eigen::Quaterniond::Identity(),
                                        Vec3(k == 0 ? 1 : 0, 0, 0)});
                          return state_after(build.finish(), method, 0.01, 200).v(0, ball);
                        }});
}

void oblique_rows(Ledger& rows) {
  constexpr double e = 0.5;
  for (const double friction : {0.1, 0.19, 0.191, 0.5}) {
    const double lost = std::min(friction * (1 + e), 2.0 / 7);
    const auto end = [friction](const Method& method) {
      BodyScene build({.friction = friction, .restitution = e}, 0);
      build.ground();
      build.ball(radius, 1, at_height(radius + 0.05, Vec3(1, 0, -1)));
      return state_after(build.finish(), method, 0.01, 20);
    };
    const LedgerRow row{
        .statement = "a ball that strikes at an angle slides or sticks by Coulomb's law",
        .unit = "m/s",
        .scene = fmt::format("ball at (1, 0, -1) m/s, restitution 0.5, friction {:g}", friction),
        .method = flight_method(),
        .bound = exact_impacts};
    LedgerRow speed = row, spin = row;
    speed.id = fmt::format("impact.oblique_speed_{:g}", friction);
    speed.quantity = "speed along the ground";
    speed.formula = "v - min(mu (1 + e) v_n, 2 v/7)";
    speed.expected = [lost] { return 1 - lost; };
    speed.run = [end](const Method& method) { return end(method).v(0, 1); };
    spin.id = fmt::format("impact.oblique_spin_{:g}", friction);
    spin.quantity = "speed of the surface about the centre";
    spin.formula = "5/2 min(mu (1 + e) v_n, 2 v/7)";
    spin.expected = [lost] { return 2.5 * lost; };
    spin.run = [end](const Method& method) { return radius * end(method).spin(1, 1); };
    rows.push_back(std::move(speed));
    rows.push_back(std::move(spin));
  }
}

/// Newton's restitution with friction is not passive: of a slanted rod that sticks it makes energy.
void slanted_rows(Ledger& rows) {
  constexpr double h = 1e-7, e = 1, mass = 1, thickness = 1e-3, length = 1, along = 0.6, down = 1;
  constexpr double inertia = mass * (length * length + thickness * thickness) / 12;
  const double slant = std::sqrt(0.5), x = slant * (thickness - length) / 2,
               z = -slant * (thickness + length) / 2;
  const auto energy = [](const State& state) {
    return (mass * state.v.col(1).squaredNorm() + inertia * std::pow(state.spin(1, 1), 2)) / 2;
  };
  rows.push_back(
      {.id = "impact.slanted_rod",
       .statement = "an impact with friction makes no energy",
       .quantity = "kinetic energy over that before",
       .unit = "1",
       .formula = "1 at most, as e = 1",
       .source = "kane1985dynamics",
       .scene = "rod of 1 m at 45 degrees, at (0.6, 0, -1) m/s, restitution 1, friction 0.5, h = 1e-7 s",
       .method = direct_method(),
       .bound = {.absolute = 0.2 * 2.8 * h,
                 .derivation = "the rod turns at 2.8 rad/s within the step; the ratio changes by 0.2 a rad"},
       .expected = [] { return 1.0; },
       .run =
           [=](const Method& method) {
             BodyScene build({.friction = 0.5, .restitution = e}, 0);
             build.ground();
             const Eigen::Quaterniond turned(Eigen::AngleAxisd(std::acos(slant), Vec3::UnitY()));
             build.box({thickness, thickness, length}, mass,
                       {Vec3(0, 0, down * h / 2 - z), turned, Vec3(along, 0, -down)});
             const Scene scene = build.finish();
             return energy(state_after(scene, method, h, 1)) / energy(scene.initial);
           },
       .deviation = Deviation{"1 + the gain of Newton's restitution where friction sticks", [=] {
                                const double before = mass * (along * along + down * down) / 2;
                                return 1 +
                                       reference::newton_impact_gain(mass, inertia, x, z, along, -down, e) /
                                           before;
                              }}});
}

}  // namespace

void impacts(Ledger& rows) {
  bounce_rows(rows);
  sequence_rows(rows);
  oblique_rows(rows);
  slanted_rows(rows);
}

}  // namespace pbdcheck::ledger
