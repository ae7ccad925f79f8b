#include "studies/cost/contestants.h"

#include <chrono>
#include <memory>

#include "harness/interrupt.h"

namespace pbdcheck {

using namespace pbd;

WatchedStep ready_quasi_newton(const Scene& scene, double tolerance) {
  Method method;
  method.outer = "quasi_newton";
  method.tolerance = tolerance;
  method.max_outer = 2000;
  const auto workspace = std::make_shared<Workspace>(scene, method);
  return [workspace](State& state, const StepWatch& watch) {
    return step(*workspace, contested_step_s, state,
                [&](const Iterate& iterate) { watch(iterate.outer_iteration, iterate.x); });
  };
}

WatchedStep ready_rival(const Scene& scene, double tolerance) {
  const std::shared_ptr<rivals::Rival> rival = rivals::rivals()[0].make(scene, contested_step_s);
  return [rival, tolerance](State& state, const StepWatch& watch) {
    return report_of(rival->step(state, {.tolerance = tolerance}, [&](const rivals::Iterate& iterate) {
      watch(iterate.iteration, iterate.x);
    }));
  };
}

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Trace watched(const WatchedStep& step, const State& start, const Points& exact) {
  Trace trace;
  State end = start;
  double watching = 0;
  const double begun = now_s();
  trace.report = step(end, [&](int iteration, const Points& x) {
    const double entered = now_s();
    throw_if_interrupted();
    trace.points.push_back({.outer_iterations = iteration,
                            .wall_s = entered - begun - watching,
                            .error = relative_error(x, exact, start.x)});
    watching += now_s() - entered;
  });
  trace.points.back().wall_s = now_s() - begun - watching;
  return trace;
}

}  // namespace pbdcheck
