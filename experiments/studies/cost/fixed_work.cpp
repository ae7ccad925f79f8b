#include "studies/cost/fixed_work.h"

#include <algorithm>
#include <chrono>

namespace pbdcheck {

using namespace pbd;

FixedRun FixedWork::run(const Scene& scene, const AfterStep& after) const {
  using Clock = std::chrono::steady_clock;
  Method method;
  method.relaxation = "gauss_seidel";
  method.outer = outer;
  method.tolerance = 0;  // never met: every run does the same work
  method.max_outer = 2;
  method.max_sweeps = 10;
  Workspace workspace(scene, method);
  State state = scene.initial;
  const auto seconds_of = [&](int count) {
    const auto start = Clock::now();
    for (int k = 0; k < count; ++k) {
      step(workspace, 1.0 / 240, state);
      if (after) after(workspace, state);
    }
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  const double first = seconds_of(1), later = seconds_of(steps - 1);
  return {state, first, later, workspace.costs()};
}

TimesBeside FixedWork::beside(const Scene& a, const Scene& b, const AfterStep& after_a) const {
  constexpr int repeats = 5;
  run(a, after_a);
  run(b);
  struct Quickest {
    double first = infinity, later = infinity;
    void add(const FixedRun& run) { first = std::min(first, run.first), later = std::min(later, run.later); }
  };
  TimesBeside times;
  Quickest all_a, all_b;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    Quickest of_a, of_b;
    for (int turn = 0; turn < turns; ++turn) {
      const FixedRun one = run(a, after_a), two = run(b);
      of_a.add(one), all_a.add(one);
      of_b.add(two), all_b.add(two);
    }
    times.ratios.push_back(of_a.later / of_b.later);
  }
  times.first = (all_a.first - all_b.first) * (steps - 1) / all_b.later;
  return times;
}

}  // namespace pbdcheck
