// What a chain of bodies costs over its length.
#include <algorithm>
#include <cmath>
#include <ctime>

#include "harness/measure.h"
#include "harness/order_fit.h"
#include "linear/linear_names.h"
#include "scenes/mechanisms.h"
#include "step/step.h"
#include "studies/bodies/joints.h"

namespace pbdcheck {

using namespace pbd;

namespace {

struct Lengths {
  std::vector<double> size;
  std::vector<std::vector<double>> step, sweep;  // processor's seconds: of each repeat, of each size
  bool diverged = false;
};

/// A step of a chain of bodies at four linearisations of one sweep each (fewer where only rounding is left),
/// and one of these; at so small a step that the solver needs no estimate of plain's contraction, whose
/// sweeps would count. A repeat is the quickest of three.
Lengths time_lengths(std::string_view relaxation, const std::vector<int>& counts) {
  constexpr double h = 1e-4;  // s
  constexpr std::size_t repeats = 3, tries = 3;
  Method method;
  method.relaxation = relaxation;
  method.outer = "plain";
  method.tolerance = 0;
  method.max_outer = 4;
  method.max_sweeps = 1;
  Lengths found;
  found.size.assign(counts.begin(), counts.end());
  found.step.assign(repeats, std::vector<double>(counts.size(), infinity));
  found.sweep = found.step;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const Scene scene = rod_chain(counts[k]);
    Workspace workspace(scene, method);
    State warm = scene.initial;
    step(workspace, h, warm);  // the memory is touched for the first time
    for (std::size_t n = 0; n < repeats * tries; ++n) {
      State state = scene.initial;
      const std::clock_t start = std::clock();
      const Report report = step(workspace, h, state);
      const double spent = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
      const auto sweeps = static_cast<double>(std::max<std::int64_t>(report.sweeps, 1));
      double &by_step = found.step[n / tries][k], &by_sweep = found.sweep[n / tries][k];
      by_step = std::min(by_step, spent);
      by_sweep = std::min(by_sweep, spent / sweeps);
      found.diverged = found.diverged || report.status == Status::diverged;
    }
  }
  return found;
}

/// The slope of each repeat.
std::vector<double> slopes(const Lengths& found, const std::vector<std::vector<double>>& times) {
  std::vector<double> all;
  for (const auto& time : times)
    all.push_back(found.diverged ? std::nan("") : fitted_order(found.size, time));
  return all;
}

}  // namespace

void joint_lengths(Context& context) {
  const std::vector<int> counts{50, 200, 800, 3200};
  Table table = context.table("lengths", {"relaxation", "bodies", "cpu_s_per_step", "cpu_s_per_sweep",
                                          "exponent_step", "exponent_sweep", "status", "reason"});
  WorstSpread worst;
  for (const auto relaxation : general_solver_names()) {
    const Lengths found = time_lengths(relaxation, counts);
    const Measured by_step(slopes(found, found.step)), by_sweep(slopes(found, found.sweep));
    const auto quickest = [&](const std::vector<std::vector<double>>& times, std::size_t k) {
      double best = infinity;
      for (const auto& time : times) best = std::min(best, time[k]);
      return found.diverged ? std::nan("") : best;
    };
    for (std::size_t k = 0; k < counts.size(); ++k)
      table.row({std::string(relaxation), std::int64_t{counts[k]}, quickest(found.step, k),
                 quickest(found.sweep, k), by_step.value, by_sweep.value,
                 std::string(found.diverged ? "diverged" : "ok"), std::string("fixed work")});
    worst.add(off_linear(slopes(found, found.sweep)), relaxation);
  }
  context.verdict(
      Basis::theory, "joints.linear",
      "a linearisation of a chain, and a sweep, cost time linear in its length, nearer than n^(4/3)",
      "|exponent - 1| from 50 to 3200 bodies (" + worst.owner() + ")", worst.value(), off_linear_bound);
  table.close();
}

}  // namespace pbdcheck
