#include "measure.h"

#include <algorithm>
#include <chrono>

#include "interrupt.h"

namespace pbdcheck {
namespace {

using Clock = std::chrono::steady_clock;

double seconds(Clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

double relative_error(const pbd::Points& x, const pbd::Points& reference, const pbd::Points& start) {
  const auto farthest = [](const pbd::Points& d) {
    return d.colwise().stableNorm().maxCoeff<Eigen::PropagateNaN>();
  };
  const double displacement = farthest(reference - start);
  const double error = farthest(x - reference);
  if (!std::isfinite(displacement)) return std::nan("");
  return displacement > 0 ? error / displacement : error;
}

Trace measure_once(const pbd::Scene& scene, const pbd::State& state, double h, const pbd::Method& method,
                   const pbd::Points& reference_x) {
  Trace trace;
  pbd::Workspace workspace(scene, method);
  pbd::State end = state;
  Clock::duration watching{0};
  const auto start = Clock::now();
  const auto observe = [&](const pbd::Iterate& iterate) {
    const auto entered = Clock::now();
    throw_if_interrupted();
    const double residual = std::max(iterate.primal, iterate.dual);
    trace.points.push_back({iterate.outer_iteration, iterate.sweeps, iterate.row_updates,
                            seconds(entered - start - watching),
                            relative_error(iterate.x, reference_x, state.x),
                            iterate.scale > 0 ? residual / iterate.scale : residual});
    watching += Clock::now() - entered;
  };
  trace.report = pbd::step(scene, method, h, end, workspace, observe);
  const double wall = seconds(Clock::now() - start - watching);
  const pbd::Report& report = trace.report;
  if (trace.points.empty() || trace.points.back().outer_iterations != report.outer_iterations)
    trace.points.push_back({report.outer_iterations, report.sweeps, report.row_updates, wall,
                            relative_error(end.x, reference_x, state.x), report.residual()});
  return trace;
}

Trace measure(const pbd::Scene& scene, const pbd::State& state, double h, const pbd::Method& method,
              const pbd::Points& reference_x) {
  measure_once(scene, state, h, method, reference_x);
  Trace best = measure_once(scene, state, h, method, reference_x);
  for (int repeat = 1; repeat < timed_repeats; ++repeat) {
    const Trace other = measure_once(scene, state, h, method, reference_x);
    for (std::size_t i = 0; i < std::min(best.points.size(), other.points.size()); ++i)
      best.points[i].wall_s = std::min(best.points[i].wall_s, other.points[i].wall_s);
  }
  return best;
}

}  // namespace pbdcheck
