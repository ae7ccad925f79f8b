// Springs of one mass: what one step of each integrator makes of them, exactly; chains of springs.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "closed_form.h"
#include "harness/oscillation.h"
#include "ledger/families.h"
#include "ledger/motion.h"
#include "studies/time/damped_oscillators.h"

namespace pbdcheck::ledger {
namespace {

using namespace pbd;
using reference::Discrete;

/// The tolerance of a step, 1e-12 of its scale, over the steps that are measured, at most 1e3.
const LedgerBound rounding_of_steps{.relative = 1e-9,
                                    .derivation = "tolerance 1e-12 of each step's scale, 1e3 steps"};

Method oscillator_rule(std::string_view integrator) {
  Method method = direct_method(integrator);
  method.alpha = 0.5;
  return method;
}

/// 1 kg on a spring of w rad/s, let go 1 m from its place.
Scene spring(double w) {
  Scene scene;
  add_node(scene, Vec3(1, 0, 0), 1);
  scene.effects.emplace_back(Anchor{{0}, {Vec3::Zero()}, {1 / (w * w)}});
  return scene;
}

/// Growth and phase of a step, from four values about a radian apart, after the steps in which the other
/// roots of rules of two steps die out.
Discrete growth_and_phase(const Scene& scene, const Method& method, double w, double h,
                          const Observable& value) {
  constexpr int settled = 40;
  const int apart = std::max(1, static_cast<int>(std::lround(1 / (w * h))));
  Motion motion(scene, method);
  motion.advance(h, settled);
  std::array<double, 4> q{};
  for (double& each : q) {
    motion.advance(h, apart);
    each = value(motion.state);
  }
  const Discrete found = sampled_oscillation(q[0], q[1], q[2], q[3]);
  return {std::pow(found.growth, 1.0 / apart), found.phase / apart};
}

struct IntegratorAnswer {
  const char *integrator, *name, *growth, *phase;
  Discrete (*exact)(double wh);
};

constexpr double w = 2 * std::numbers::pi;  // rad/s

void integrator_rows(Ledger& rows, const IntegratorAnswer& rule, double h) {
  const auto measured = [h](const Method& method) {
    return growth_and_phase(spring(w), method, w, h, [](const State& state) { return state.x(0, 0); });
  };
  const std::string id = fmt::format("oscillator.{}_{:g}", rule.integrator, h);
  const LedgerRow row{.unit = "1",
                      .scene = fmt::format("1 kg on a spring of 2 pi rad/s, h = {:g} s", h),
                      .method = oscillator_rule(rule.integrator),
                      .bound = rounding_of_steps};
  LedgerRow amplitude = row, frequency = row;
  amplitude.id = id + "_amplitude";
  amplitude.statement =
      fmt::format("{} leaves of an oscillation what its amplification factor says", rule.name);
  amplitude.quantity = "amplitude after 1 s over that at the start";
  amplitude.formula = rule.growth;
  amplitude.expected = [h, exact = rule.exact] { return std::pow(exact(w * h).growth, 1 / h); };
  amplitude.run = [=](const Method& method) { return std::pow(measured(method).growth, 1 / h); };
  frequency.id = id + "_frequency";
  frequency.statement = fmt::format("{} turns the phase of an oscillation as its rule says", rule.name);
  frequency.quantity = "frequency over that of the spring";
  frequency.formula = rule.phase;
  frequency.expected = [h, exact = rule.exact] { return exact(w * h).phase / (w * h); };
  frequency.run = [=](const Method& method) { return measured(method).phase / (w * h); };
  rows.push_back(std::move(amplitude));
  rows.push_back(std::move(frequency));
}

void damped_rows(Ledger& rows) {
  Method method = direct_method();
  method.outer = "plain";  // which solves linear rows but for rounding
  for (const double h : {0.1, 0.01, 0.001}) {
    const auto exact = [h] {
      return reference::implicit_euler_damped_oscillator(10 * h, reference::damped_spring(100, 1, 1).ratio);
    };
    rows.push_back({.id = fmt::format("oscillator.damped_{:g}_decrement", h),
                    .statement = "a damped spring decays as implicit Euler's rule for its constraint says",
                    .quantity = "logarithmic decrement",
                    .unit = "1",
                    .formula = "2 pi ln(sqrt(1 + 2 zeta w h + (w h)^2))/phase",
                    .scene = fmt::format("k = 100 N/m, m = 1 kg, c = 1 N s/m, h = {:g} s", h),
                    .method = method,
                    .bound = rounding_of_steps,
                    .expected = [exact] { return reference::logarithmic_decrement(exact()); },
                    .run =
                        [h](const Method& method) {
                          const Oscillator spring = damped_springs();
                          return reference::logarithmic_decrement(
                              growth_and_phase(spring.scene, method, spring.frequency, h,
                                               [](const State& state) { return state.x(0, 1); }));
                        }});
  }
}

// ---- chains of springs

constexpr int links = 20;
constexpr double stiffness = 1e4;  // N/m

Scene hung_springs(double stretch_m) {
  Scene scene;
  Distance springs;
  add_node(scene, Vec3::Zero(), infinity);
  for (int i = 1; i <= links; ++i) {
    add_node(scene, Vec3(0, 0, -i * (1 + stretch_m)), 1);
    springs.node.push_back({i - 1, i});
    springs.rest_length.push_back(1);
    springs.compliance.push_back(1 / stiffness);
  }
  scene.effects.emplace_back(std::move(springs));
  return scene;
}

void chain_rows(Ledger& rows) {
  const std::string scene = "20 springs of 1e4 N/m with 1 kg each, hung";
  rows.push_back({.id = "oscillator.spring_chain_stretch",
                  .statement = "a hung chain of springs stretches as the sum of what each carries",
                  .quantity = "stretch",
                  .unit = "m",
                  .formula = "m g n (n + 1)/(2 k)",
                  .scene = scene,
                  .method = direct_method(),
                  .bound = {.relative = 1e-9, .derivation = "exact but for the tolerance"},
                  .expected = [] { return reference::spring_chain_stretch(links, stiffness, 1, 9.81); },
                  .run =
                      [](const Method& method) {
                        Scene hung = hung_springs(0);
                        hung.effects.emplace_back(Gravity{});
                        return -equilibrium(hung, method, 10).x(2, links) - links;
                      }});
  rows.push_back(
      {.id = "oscillator.spring_chain_frequency",
       .statement = "its lowest mode has the frequency of the chain of masses",
       .quantity = "frequency",
       .unit = "Hz",
       .formula = "2 sqrt(k/m) sin(pi/(2 (2 n + 1)))/(2 pi)",
       .scene = scene + ", h = 0.1 s",
       .method = direct_method(),
       .bound = {.relative = 1e-8,
                 .derivation = "implicit Euler's phase undone; other modes fall to 1e-12 in 40 steps"},
       .expected = [] { return reference::spring_chain_frequency(links, stiffness, 1); },
       .run =
           [](const Method& method) {
             return slowest_frequency(hung_springs(1e-3), method, 0.1, 40,
                                      [](const State& state) { return state.x(2, links) + links; });
           }});
}

void stretch_rows(Ledger& rows) {
  for (const double h : {1.0, 0.01})
    rows.push_back({.id = fmt::format("oscillator.stretch_{:g}", h),
                    .statement = "a compliant constraint stretches as a spring, whatever the step",
                    .quantity = "stretch at rest",
                    .unit = "m",
                    .formula = "m g/k",
                    .scene = fmt::format("1 kg hung on 1e-4 m/N, h = {:g} s", h),
                    .method = direct_method(),
                    .bound = {.relative = 1e-9, .derivation = "exact but for the tolerance"},
                    .expected = [] { return 9.81 * 1e-4; },
                    .run =
                        [h](const Method& method) {
                          Scene scene;
                          add_node(scene, Vec3::Zero(), infinity);
                          add_node(scene, Vec3(0, 0, -1), 1);
                          scene.effects.emplace_back(Gravity{});
                          scene.effects.emplace_back(
                              Distance{.node = {{0, 1}}, .rest_length = {1}, .compliance = {1e-4}});
                          return -1 - equilibrium(scene, method, h).x(2, 1);
                        }});
}

}  // namespace

void oscillators(Ledger& rows) {
  const IntegratorAnswer rules[]{
      {"implicit_euler", "implicit Euler", "(1 + (w h)^2)^(-1/(2 h))", "atan(w h)/(w h)",
       reference::implicit_euler_oscillator},
      {"newmark", "Newmark's rule (1/4, 1/2)", "1", "2 atan(w h/2)/(w h)", reference::newmark_oscillator},
      {"bdf2", "BDF2", "|z|^(1/h), principal root of (3 - 2 i w h) z^2 - 4 z + 1 = 0", "arg(z)/(w h)",
       reference::bdf2_oscillator},
      {"symplectic_euler", "symplectic Euler", "1", "2 asin(w h/2)/(w h)",
       reference::symplectic_euler_oscillator}};
  for (const auto& rule : rules)
    for (const double h : {0.1, 0.01, 0.001}) integrator_rows(rows, rule, h);
  damped_rows(rows);
  stretch_rows(rows);
  chain_rows(rows);
}

}  // namespace pbdcheck::ledger
