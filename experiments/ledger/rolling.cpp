// Bodies that slip until they roll, and spin down.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "closed_form_contact.h"
#include "ledger/families.h"
#include "ledger/motion.h"
#include "scenes/contacts.h"
#include "studies/contact/contact_answers.h"

namespace pbdcheck::ledger {
namespace {

using namespace pbd;

void roll_rows(Ledger& rows) {
  struct Case {
    const char* name;
    Round shape;
    double share;
  };
  for (const Case& c :
       {Case{"ball", Round::ball, 0.4}, {"cylinder", Round::cylinder, 0.5}, {"hoop", Round::hoop, 1}}) {
    const LedgerRow row{.scene = fmt::format("{} of 0.1 m at 1 m/s, friction 0.2, h = 0.001 s", c.name),
                        .method = direct_method()};
    LedgerRow speed = row, way = row;
    speed.id = fmt::format("friction.roll_{}_speed", c.name);
    speed.statement = "a body that slips rolls in the end";
    speed.quantity = "speed of rolling";
    speed.unit = "m/s";
    speed.formula = "v/(1 + I/(m r^2))";
    speed.bound = {.relative = 1e-9, .derivation = "velocities are exact; tolerance"};
    speed.expected = [c] { return reference::slip_to_roll(c.share, 1, 0.2, gravity).speed; };
    speed.run = [c](const Method& method) {
      return state_after(slipping(c.shape), method, 1e-3, 400).v(0, 1);
    };
    way.id = fmt::format("friction.roll_{}_way", c.name);
    way.statement = "and slips as far as friction takes to slow it";
    way.quantity = "way of slip";
    way.unit = "m";
    way.formula = "(v^2 - v_end^2)/(2 mu g) - h (v - v_end)/2";
    way.bound = {.absolute = 0.2 * gravity * 1e-6 / 8 + 1e-9,
                 .derivation = "mu g h^2/8: the last step of slip is cut anywhere"};
    way.expected = [c] {
      const auto exact = reference::slip_to_roll(c.share, 1, 0.2, gravity);
      return exact.way - 1e-3 * (1 - exact.speed) / 2;
    };
    way.run = [c](const Method& method) {
      const auto exact = reference::slip_to_roll(c.share, 1, 0.2, gravity);
      const State end = state_after(slipping(c.shape), method, 1e-3, 400);
      return end.x(0, 1) - end.v(0, 1) * (end.time - exact.time);
    };
    rows.push_back(std::move(speed));
    rows.push_back(std::move(way));
  }
}

void spin_down_rows(Ledger& rows) {
  constexpr double radius = 0.1, friction = 0.2;
  const double spin = 10;  // rad/s
  const LedgerRow row{.quantity = "time to rest",
                      .unit = "s",
                      .method = patient_method("conjugate_gradients"),
                      .bound = {.relative = 1e-9, .derivation = "velocities are exact; tolerance"}};
  const auto time = [spin](double share) {
    return [=](const Method& method) {
      BodyScene build({.friction = friction});
      build.ground();
      build.cylinder(radius, 0.05, 1, {.position = Vec3(0, 0, 0.025), .spin = Vec3(0, 0, spin)});
      Scene scene = build.finish();
      const double thick = 0.05 * 0.05 / 12;  // m^2
      scene.bodies[1].inertia = share * radius * radius * Vec3(0.5, 0.5, 1) + Vec3(thick, thick, 0);
      const State end = state_after(scene, method, contact_h, 10);
      return spin * end.time / (spin - end.spin(2, 1));
    };
  };
  LedgerRow ring = row, disc = row;
  ring.id = "friction.spin_down_ring";
  ring.statement = "friction on its rim stops a spinning ring";
  ring.formula = "w r/(mu g)";
  ring.scene = "ring of 0.1 m flat on the ground at 10 rad/s, friction 0.2";
  ring.expected = [spin] { return reference::spin_down_rim(1, spin, radius, friction, gravity); };
  ring.run = time(1);
  disc.id = "friction.spin_down_disc";
  disc.statement = "friction under all of it stops a spinning disc";
  disc.formula = "3 w r/(4 mu g)";
  disc.scene = "disc of 0.1 m flat on the ground at 10 rad/s, friction 0.2";
  disc.expected = [spin] { return reference::spin_down_disc(0.5, spin, radius, friction, gravity); };
  disc.run = time(0.5);
  disc.deviation = {"contacts on the rim, where a flat cylinder has its own: w r/(2 mu g)",
                    [spin] { return reference::spin_down_rim(0.5, spin, radius, friction, gravity); }};
  rows.push_back(std::move(ring));
  rows.push_back(std::move(disc));
}

// ---- a ring that slides and spins, a thin disc that rolls round

void sliding_ring_row(Ledger& rows) {
  static constexpr double radius = 0.1, speed = 1, time = 0.2;
  Method ring = patient_method("conjugate_gradients");
  ring.tolerance = 1e-10;
  rows.push_back({.id = "friction.sliding_ring",
                  .statement = "a ring that slides and spins ends with its rim as fast as its centre",
                  .quantity = "speed over that of the rim",
                  .unit = "1",
                  .formula = "1, the only ratio that stays",
                  .scene = "ring of 0.1 m flat on the ground at 1 m/s and 10 rad/s, friction 0.2, 0.2 s",
                  .method = ring,
                  .bound = {.absolute = 0.2 * gravity * 1e-3 / speed, .derivation = "order 1: mu g h/v"},
                  .expected = [] { return 1.0; },
                  .run =
                      [](const Method& method) {
                        BodyScene build({.friction = 0.2});
                        build.ground();
                        const double turns = speed / radius;
                        build.cylinder(radius, 1e-3, 1,
                                       {Vec3(0, 0, 5e-4), Eigen::Quaterniond::Identity(),
                                        Vec3(1.0 * speed, 0, 0), Vec3(0, 0, turns)});
                        Scene scene = build.finish();
                        scene.bodies[1].inertia = radius * radius * Vec3(0.5, 0.5, 1);
                        const State end = state_after(scene, method, 1e-3, std::lround(time / 1e-3));
                        return end.v.col(1).norm() / (end.spin(2, 1) * radius);
                      }});
}

void rolling_disc_row(Ledger& rows) {
  static constexpr double radius = 0.05, angle = std::numbers::pi / 18, h = 1e-5, time = 0.01, thick = 1e-6;
  const double rate = reference::rolling_disc_rate(radius, angle, gravity);
  rows.push_back(
      {.id = "friction.rolling_disc",
       .statement = "a thin disc rolls round with its centre at rest",
       .quantity = "rate of its tilt",
       .unit = "rad/s",
       .formula = "sqrt(4 g/(r sin(angle)))",
       .source = "landau1976mechanics",
       .scene = "disc of 0.05 m and 1e-6 m thick at 10 degrees from the floor, friction 1, 0.01 s",
       .method = direct_method(),
       .bound = {.relative = std::pow(rate * h, 2) + thick / radius,
                 .derivation = "order 1, h = 1e-5 s and h/2 extrapolated: (w h)^2; thickness over radius"},
       .expected = [rate] { return rate; },
       .run =
           [rate](const Method& method) {
             const Eigen::Quaterniond tilt(Eigen::AngleAxisd(angle, Vec3::UnitX()));
             // Tilted about x, it touches below its -y; it turns about that radius.
             BodyScene build({.friction = 1});
             build.ground();
             const double height = radius * std::sin(angle) + thick / 2 * std::cos(angle);
             build.cylinder(radius, thick, 1,
                            {Vec3(0, 0, height), tilt, Vec3::Zero(), Vec3(0, rate * std::sin(angle), 0)});
             const Scene scene = build.finish();
             const Vec3 before = tilt * Vec3::UnitZ();
             return std::abs(extrapolated(
                 [&](double step) {
                   const State end = state_after(scene, method, step, std::lround(time / step));
                   return turning_rate(Vec3::UnitZ(), before, end.orientation[1] * Vec3::UnitZ(), time);
                 },
                 h, 1));
           }});
}

}  // namespace

void rolling(Ledger& rows) {
  roll_rows(rows);
  spin_down_rows(rows);
  sliding_ring_row(rows);
  rolling_disc_row(rows);
}

}  // namespace pbdcheck::ledger
