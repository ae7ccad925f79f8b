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

enum class Round { ball, cylinder, hoop };

Scene slipping(Round shape) {
  constexpr double radius = 0.1, speed = 1;
  BodyScene build({.friction = 0.2});
  build.ground();
  const Eigen::Quaterniond lying(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX()));
  if (shape == Round::ball)
    build.ball(radius, 1, {Vec3(0, 0, radius), Eigen::Quaterniond::Identity(), Vec3(speed, 0, 0)});
  else
    build.cylinder(radius, 0.2, 1, {Vec3(0, 0, radius), lying, Vec3(speed, 0, 0)});
  Scene scene = build.finish();
  if (shape == Round::hoop) scene.bodies[1].inertia.z() = radius * radius;
  return scene;
}

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

void spin_rows(Ledger& rows) {
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

}  // namespace

void rolling(Ledger& rows) {
  roll_rows(rows);
  spin_rows(rows);
}

}  // namespace pbdcheck::ledger
