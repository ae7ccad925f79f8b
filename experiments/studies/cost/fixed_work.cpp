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
  const auto start = Clock::now();
  for (int k = 0; k < steps; ++k) {
    step(workspace, 1.0 / 240, state);
    if (after) after(workspace, state);
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return {state, seconds, workspace.costs()};
}

std::vector<double> FixedWork::time_ratios(const Scene& a, const Scene& b, const AfterStep& after_a) const {
  constexpr int repeats = 5;
  run(a, after_a);
  run(b);
  std::vector<double> all;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    double first = infinity, second = infinity;
    for (int turn = 0; turn < turns; ++turn) {
      first = std::min(first, run(a, after_a).seconds);
      second = std::min(second, run(b).seconds);
    }
    all.push_back(first / second);
  }
  return all;
}

}  // namespace pbdcheck
