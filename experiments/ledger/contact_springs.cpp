// Springs that masses land on or rub beside: one mass as a node on the ground.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "closed_form_contact.h"
#include "harness/oscillation.h"
#include "ledger/families.h"
#include "ledger/motion.h"
#include "scenes/contacts.h"

namespace pbdcheck::ledger {
namespace {

using namespace pbd;

double place_of(const State& state, int axis) {
  return state.x(axis, 1);
}

/// A node of 1 kg at `position` over ground of the law; node 1.
Scene node_on_ground(const ContactLaw& law, const Vec3& position) {
  BodyScene build(law);
  build.ground();
  build.contact().node = {1};
  build.contact().radius = {0};
  build.contact().node_material = {0};
  Scene scene = build.finish();
  add_node(scene, position, 1);
  return scene;
}

// ---- landing on a massless spring: contact of compliance 1/k

constexpr double landing_stiffness = 1000, height = 0.1, landing_h = 1e-4;  // N/m, m, s

void landing_rows(Ledger& rows) {
  const double w = std::sqrt(landing_stiffness);
  const auto scene = [] {
    return node_on_ground({.friction = 0, .compliance = 1 / landing_stiffness}, Vec3(0, 0, height));
  };
  const auto exact = [] { return reference::spring_landing(landing_stiffness, 1, gravity, height); };
  const LedgerRow row{.scene = "1 kg dropped 0.1 m on contact of 1e-3 m/N, h = 1e-4 s and h/2",
                      .method = direct_method()};
  LedgerRow depth = row, time = row;
  depth.id = "contact_spring.landing_depth";
  depth.statement = "a mass that lands on a spring compresses it as its energy says";
  depth.quantity = "largest compression";
  depth.unit = "m";
  depth.formula = "s + sqrt(s^2 + 2 s height), s = m g/k";
  // The touch falls anywhere in a step, in which the spring acts from its end on: v w h^2.
  depth.bound = {.absolute = std::sqrt(2 * gravity * height) * w * landing_h * landing_h +
                             std::pow(w * landing_h, 2) * 0.06,
                 .derivation = "order 1 extrapolated, touch within a step: v w h^2 + (w h)^2 of the depth"};
  depth.expected = [exact] { return exact().compression; };
  depth.run = [scene](const Method& method) {
    return extrapolated(
        [&](double step) {
          Motion motion(scene(), method);
          double lowest = 0;
          do {
            motion.advance(step);
            lowest = std::min(lowest, place_of(motion.state, 2));
          } while (lowest == 0 || motion.state.v(2, 1) < 0);
          return -lowest;
        },
        landing_h, 1);
  };
  time.id = "contact_spring.landing_time";
  time.statement = "and stays on it for more than half a period";
  time.quantity = "time of contact";
  time.unit = "s";
  time.formula = "2/w (pi/2 + atan(g/(w v)))";
  time.bound = {
      .absolute = 2 * w * landing_h * landing_h + std::pow(w * landing_h, 2) * 0.11,
      .derivation = "order 1 extrapolated, touch and lift within steps: 2 w h^2 + (w h)^2 of the time"};
  time.expected = [exact] { return exact().time; };
  time.run = [scene](const Method& method) {
    const auto height_over = [](const State& state) { return place_of(state, 2); };
    const auto speed_of = [](const State& state) { return state.v(2, 1); };
    return extrapolated(
        [&](double step) {
          return passage(scene(), method, step, height_over, speed_of, 1, 2) -
                 passage(scene(), method, step, height_over, speed_of, 1, 1);
        },
        landing_h, 1);
  };
  rows.push_back(std::move(depth));
  rows.push_back(std::move(time));
}

// ---- a mass on a spring that rubs on the ground

constexpr double rub_stiffness = 100, rub_friction = 0.1, amplitude = 0.1, rub_h = 1e-3;

Scene rubbing() {
  Scene scene = node_on_ground({.friction = rub_friction}, Vec3(amplitude, 0, 0));
  scene.effects.emplace_back(Anchor{{1}, {Vec3::Zero()}, {1 / rub_stiffness}});
  return scene;
}

/// Where it turns first.
double turning_place(const Method& method, double h) {
  Motion motion(rubbing(), method);
  motion.advance(h);
  while (true) {
    const State before = motion.state;
    motion.advance(h);
    const double v0 = before.v(0, 1), v1 = motion.state.v(0, 1);
    if (v0 * v1 > 0) continue;
    return before.x(0, 1) + h * v0 / (v0 - v1) * v0 / 2;
  }
}

void rubbing_rows(Ledger& rows) {
  const double w = std::sqrt(rub_stiffness);
  const LedgerRow row{
      .scene = "1 kg on 100 N/m with friction 0.1, let go at 0.1 m, h = 0.001 s and h/2",
      .method = direct_method(),
      .bound = {.absolute = std::pow(w * rub_h, 2) * amplitude * std::numbers::pi,
                .derivation = "order 1 extrapolated: (w h)^2 of the amplitude over half a turn"}};
  LedgerRow loss = row, period = row, rest = row;
  loss.id = "contact_spring.friction_loss";
  loss.statement = "friction shortens each half swing of a mass on a spring alike";
  loss.quantity = "loss of the first half swing";
  loss.unit = "m";
  loss.formula = "2 mu m g/k";
  loss.expected = [] { return reference::friction_swing_loss(rub_stiffness, 1, rub_friction, gravity); };
  loss.run = [](const Method& method) {
    return amplitude + extrapolated([&](double step) { return turning_place(method, step); }, rub_h, 1);
  };
  period.id = "contact_spring.friction_period";
  period.statement = "and does not change its period";
  period.quantity = "period, by the phase of the speed";
  period.unit = "s";
  period.formula = "2 pi sqrt(m/k)";
  period.bound = {.relative = 1e-9, .derivation = "implicit Euler's phase atan(w h) undone; tolerance"};
  period.expected = [w] { return 2 * std::numbers::pi / w; };
  period.run = [](const Method& method) {
    constexpr int apart = 50;  // steps, half a radian: all within the first half swing
    Motion motion(rubbing(), method);
    std::array<double, 4> v{};
    for (double& each : v) {
      motion.advance(rub_h, apart);
      each = motion.state.v(0, 1);
    }
    const double phase = sampled_oscillation(v[0], v[1], v[2], v[3]).phase / apart;
    return 2 * std::numbers::pi * rub_h / std::tan(phase);
  };
  rest.id = "contact_spring.friction_rest";
  rest.statement = "the mass stays where the spring no longer overcomes friction";
  rest.quantity = "place of rest";
  rest.unit = "m";
  rest.formula = "amplitude less 2 mu m g/k a half swing, until |x| <= mu m g/k";
  const double stop = rub_friction * gravity / rub_stiffness;  // m, from the middle, where it may rest
  const double half_swings = std::ceil((amplitude - stop) / (2 * stop));
  rest.bound.absolute *= half_swings;
  rest.bound.derivation += fmt::format(", in each of {:g} half swings", half_swings);
  rest.expected = [] {
    return reference::friction_swing_rest(rub_stiffness, 1, rub_friction, gravity, amplitude);
  };
  rest.run = [](const Method& method) {
    return extrapolated(
        [&](double step) { return state_after(rubbing(), method, step, std::lround(2.5 / step)).x(0, 1); },
        rub_h, 1);
  };
  rows.push_back(std::move(loss));
  rows.push_back(std::move(period));
  rows.push_back(std::move(rest));
}

}  // namespace

void contact_springs(Ledger& rows) {
  landing_rows(rows);
  rubbing_rows(rows);
}

}  // namespace pbdcheck::ledger
