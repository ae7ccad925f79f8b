// Does damping inside the constraints take what its coefficient says, whatever the sweeps, and nothing of
// rigid motion? Decrements of damped oscillators are held against the matrix that an integrator's step makes
// of q'' = -w^2 (q + T q'): masses between two walls on damped springs, and one free regular tetrahedron
// that breathes or shears, with moduli of elasticity and of damping of its own. Rigid motion is
// in damped_rotation.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include <fmt/format.h>

#include "harness/measure.h"
#include "harness/oscillation.h"
#include "studies/experiments.h"
#include "studies/time/damped.h"
#include "studies/time/damped_oscillators.h"

namespace pbdcheck {
namespace {

using namespace pbd;
using reference::Discrete;
using reference::OscillatorRule;

constexpr double solved = 1e-13;  // the steps' tolerance

// ---- decrements

struct DampedRun {
  const Oscillator* oscillator;
  OscillatorRule rule;
  std::string outer;
  int sweeps;
  double h;
  double decrement = std::nan(""), exact = std::nan(""), rate = std::nan("");
  std::int64_t row_updates = 0;
  Status status = Status::ok;
  std::string_view reason{};

  double error() const { return status == Status::ok ? std::abs(decrement / exact - 1) : std::nan(""); }
};

void measure(DampedRun& run) {
  const Oscillator& oscillator = *run.oscillator;
  Method method = oscillator_method(run.rule);
  method.outer = run.outer;
  method.max_sweeps = run.sweeps;
  method.tolerance = solved;
  Workspace workspace(oscillator.scene, method);
  State state = oscillator.scene.initial;
  const int n = std::max(1, static_cast<int>(std::lround(1 / (run.h * oscillator.frequency))));
  std::vector<double> q;
  for (int k = 1; k <= run.rule.settled + 4 * n; ++k) {
    const Report report = step(workspace, run.h, state);
    run.row_updates += report.row_updates;
    if (report.status > run.status) std::tie(run.status, run.reason) = std::tie(report.status, report.reason);
    if (k > run.rule.settled && (k - run.rule.settled) % n == 0)
      q.push_back(oscillator.coordinate(oscillator.scene, state.x));
  }
  // Growth and phase of every n-th step, n about a radian.
  const Discrete found = sampled_oscillation(q[0], q[1], q[2], q[3]);
  run.decrement = reference::logarithmic_decrement(found);
  run.rate = -std::log(found.growth) / (n * run.h);
  run.exact =
      reference::logarithmic_decrement(run.rule.step(run.h, oscillator.frequency, oscillator.retardation));
}

std::vector<DampedRun> runs(const std::vector<Oscillator>& oscillators, bool full) {
  std::vector<double> steps{0.04, 0.02, 0.01, 0.005, 0.0025, 0.00125, 0.000625};
  if (full) steps.push_back(0.0003125);
  std::vector<DampedRun> all;
  for (const auto& oscillator : oscillators) {
    const bool solid = std::holds_alternative<TetStrain>(oscillator.scene.effects.front());
    for (const auto& rule : reference::oscillator_rules())
      for (const double h : steps)
        for (const std::string outer : {"plain", "quasi_newton"})
          for (const int sweeps : {10, 1000}) {
            if (outer == "quasi_newton" && (!solid || sweeps == 10 || rule.integrator == "symplectic_euler"))
              continue;
            all.push_back({&oscillator, rule, outer, sweeps, h});
          }
  }
  return all;
}

std::string id_of(const OscillatorRule& rule) {
  return rule.integrator == "newmark" ? fmt::format("newmark_{}", rule.alpha) : std::string(rule.integrator);
}

void decrements(Context& context, const std::vector<Oscillator>& oscillators) {
  auto all = runs(oscillators, context.full());
  context.parallel(std::ssize(all), [&](std::int64_t k) { measure(all[static_cast<std::size_t>(k)]); });

  Table table = context.table(
      "decrements", {"scene", "integrator", "outer", "relaxation", "max_sweeps", "step_s", "retardation_s",
                     "decrement", "predicted_decrement", "decay_per_s", "expected_decay_per_s", "order",
                     "error", "row_updates", "status", "reason"});
  for (const auto& run : all) {
    const double expected = run.oscillator->retardation * std::pow(run.oscillator->frequency, 2) / 2;
    table.row({run.oscillator->name, label(run.rule), run.outer, oscillator_method(run.rule).relaxation,
               std::int64_t{run.sweeps}, run.h, run.oscillator->retardation, run.decrement, run.exact,
               run.rate, expected, std::int64_t{run.rule.order}, run.error(), run.row_updates,
               std::string(status_names[static_cast<std::size_t>(run.status)]), std::string(run.reason)});
  }
  table.close();

  for (const auto& oscillator : oscillators) {
    Worst error;
    for (const auto& run : all)
      if (run.oscillator == &oscillator) error.add(run.error());
    context.verdict(
        Basis::theory, "damping." + oscillator.name.substr(oscillator.name.find(' ') + 1),
        "with 10 sweeps as with 1000 the decrement is that of the integrator's matrix: " + oscillator.name,
        "largest |measured/predicted - 1|", error.value(), 1e-8);
  }
  const auto limit = reference::damped_spring(spring_stiffness, 1, damping_coefficient);
  for (const auto& rule : reference::oscillator_rules()) {
    std::vector<const DampedRun*> finest;  // the springs' runs with 1000 sweeps, coarse to fine
    for (const auto& run : all)
      if (run.oscillator == oscillators.data() && label(run.rule) == label(rule) && run.sweeps == 1000)
        finest.push_back(&run);
    const auto difference = [&](const DampedRun& run) {
      return std::abs(run.rate - damping_coefficient / 2);
    };
    const DampedRun &fine = *finest.back(), &coarse = *finest[finest.size() - 2];
    // Of bdf2 the term of the next order is the larger one at long steps.
    const double order = std::log2(difference(coarse) / difference(fine));
    context.verdict(Basis::theory, "damping.order." + id_of(rule),
                    "the decay rate approaches c/(2 m) with the order of " + label(rule),
                    "|measured order - order|", std::abs(order - rule.order), 0.1);
    // Rules add to decrement and phase what is of the size of (w h)^order; half a turn has pi.
    context.verdict(
        Basis::theory, "damping.limit." + id_of(rule),
        fmt::format("the decrement by {} approaches that of k = 100 N/m, c = 1 N s/m, m = 1 kg", label(rule)),
        fmt::format("|decrement - {:.9f}| at h = {} s", limit.decrement, fine.h),
        std::abs(fine.decrement - limit.decrement),
        2 * std::numbers::pi * std::pow(fine.h * std::sqrt(spring_stiffness), rule.order));
  }
}

// ---- off means off

/// Numbers in which runs of two scenes differ.
std::int64_t differing(const OscillatorRule& rule, Scene none, Scene zero) {
  std::int64_t count = 0;
  const Method method = oscillator_method(rule);
  Workspace without(none, method), with(zero, method);
  for (int k = 0; k < 100; ++k) {
    step(without, 0.01, none.initial);
    step(with, 0.01, zero.initial);
    count += (none.initial.x.array() != zero.initial.x.array()).count() +
             (none.initial.v.array() != zero.initial.v.array()).count();
  }
  return count;
}

void off(Context& context) {
  double count = 0;
  for (const auto& rule : reference::oscillator_rules()) {
    Scene none = damped_springs().scene, zero = none;
    std::get<Distance>(none.effects[0]).damping.clear();
    std::get<Distance>(zero.effects[0]).damping = {0, 0};
    count += static_cast<double>(differing(rule, none, zero));
  }
  context.verdict(Basis::theory, "damping.off",
                  "damping that is absent and damping of zero give the same bits", "numbers that differ",
                  count, 0);
}

}  // namespace

void damping(Context& context) {
  context.begin(3);
  const std::vector<Oscillator> oscillators{damped_springs(), damped_chain(), breathing_tetrahedron(),
                                            shearing_tetrahedron()};
  decrements(context, oscillators);
  context.advance("decrements");
  damped_rotation(context);
  context.advance("rotation");
  off(context);
  context.advance("off");
}

}  // namespace pbdcheck
