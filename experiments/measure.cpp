#include "measure.h"

#include <algorithm>
#include <chrono>

#include "interrupt.h"

namespace pbdcheck {

static_assert(pbd::status_names == pbd::rivals::status_names);

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
  Clock::duration watching{0};
  const auto start = Clock::now();
  pbd::Workspace workspace(scene, method);
  pbd::State end = state;
  const auto observe = [&](const pbd::Iterate& iterate) {
    const auto entered = Clock::now();
    throw_if_interrupted();
    const double residual = std::max(iterate.primal, iterate.dual);
    trace.points.push_back({iterate.outer_iteration, iterate.sweeps, iterate.row_updates,
                            seconds(entered - start - watching),
                            relative_error(iterate.x.leftCols(scene.nodes()), reference_x, state.x),
                            iterate.scale > 0 ? residual / iterate.scale : residual});
    watching += Clock::now() - entered;
  };
  trace.report = pbd::step(scene, method, h, end, workspace, observe);
  const double wall = seconds(Clock::now() - start - watching);
  const pbd::Report& report = trace.report;
  if (trace.points.empty() || trace.points.back().outer_iterations != report.outer_iterations)
    trace.points.push_back({.outer_iterations = report.outer_iterations,
                            .error = relative_error(end.x, reference_x, state.x),
                            .residual = report.residual()});
  TracePoint& last = trace.points.back();  // with what the step does after its last iterate
  last.sweeps = report.sweeps;
  last.row_updates = report.row_updates;
  last.wall_s = wall;
  return trace;
}

Trace measure_once(const pbd::Scene& scene, const pbd::State& state, double h,
                   const pbd::rivals::NamedRival& rival, const pbd::rivals::Budget& budget,
                   const pbd::Points& reference_x) {
  Trace trace;
  const auto start = Clock::now();
  const auto made = rival.make(scene, h);
  const double making = seconds(Clock::now() - start);
  pbd::State end = state;
  trace.report = report_of(made->step(end, budget, [&](const pbd::rivals::Iterate& iterate) {
    throw_if_interrupted();
    trace.points.push_back({.outer_iterations = iterate.iteration,
                            .wall_s = making + iterate.seconds,
                            .error = relative_error(iterate.x, reference_x, state.x),
                            .residual = iterate.residual});
  }));
  return trace;
}

Trace measure(const std::function<Trace()>& once) {
  Trace best = once();
  if (best.report.status != pbd::Status::ok) return best;
  best = once();
  for (int repeat = 1; repeat < timed_repeats; ++repeat) {
    const Trace other = once();
    for (std::size_t i = 0; i < std::min(best.points.size(), other.points.size()); ++i)
      best.points[i].wall_s = std::min(best.points[i].wall_s, other.points[i].wall_s);
  }
  return best;
}

pbd::Report report_of(const pbd::rivals::Report& report) {
  pbd::Report same;
  same.status = static_cast<pbd::Status>(report.status);
  same.reason = report.reason;
  same.outer_iterations = report.iterations;
  return same;
}

}  // namespace pbdcheck
