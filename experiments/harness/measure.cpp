#include "harness/measure.h"

#include <algorithm>
#include <chrono>
#include <vector>

#include "harness/interrupt.h"
#include "names.h"
#include "rows/bodies.h"
#include "step/integrators.h"

namespace pbdcheck {

static_assert(pbd::status_names == pbd::rivals::status_names);

namespace {

using Clock = std::chrono::steady_clock;

double seconds(Clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

pbd::Points places(const pbd::Scene& scene, const pbd::Points& x,
                   const std::vector<Eigen::Quaterniond>& orientation) {
  const auto bodies = static_cast<Eigen::Index>(scene.bodies.size());
  pbd::Points all(3, scene.nodes() + 3 * bodies);
  std::vector<bool> held(scene.mass.size(), false);
  for (const pbd::RigidBody& body : scene.bodies) {
    const auto node = static_cast<std::size_t>(body.node);
    held[node] = std::isinf(scene.mass[node]);
  }
  Eigen::Index next = 0;
  for (int i = 0; i < scene.nodes(); ++i)
    if (!held[static_cast<std::size_t>(i)]) all.col(next++) = x.col(i);
  for (Eigen::Index b = 0; b < bodies; ++b) {
    const auto& [node, inertia] = scene.bodies[static_cast<std::size_t>(b)];
    if (!inertia.allFinite()) continue;
    const pbd::Vec3 arm = gyration_radii(scene, scene.bodies[static_cast<std::size_t>(b)]);
    const Eigen::Matrix3d axes = orientation[static_cast<std::size_t>(b)].toRotationMatrix();
    all.middleCols(next, 3) = (axes * arm.asDiagonal()).colwise() + x.col(node);
    next += 3;
  }
  return all.leftCols(next);
}

pbd::Vec3 gyration_radii(const pbd::Scene& scene, const pbd::RigidBody& body) {
  const double mass = scene.mass[static_cast<std::size_t>(body.node)];
  if (!std::isfinite(mass)) return pbd::Vec3::Ones();
  return (body.inertia / mass).cwiseSqrt();
}

double relative_error(const pbd::Points& x, const pbd::Points& reference, const pbd::Points& start,
                      double least) {
  const auto farthest = [](const pbd::Points& d) {
    return d.cols() > 0 ? d.colwise().stableNorm().maxCoeff<Eigen::PropagateNaN>() : 0.0;
  };
  const double displacement = std::max(farthest(reference - start), least);
  const double error = farthest(x - reference);
  if (!std::isfinite(displacement)) return std::nan("");
  const double size = start.cols() > 0 ? start.cwiseAbs().maxCoeff() : 0.0;
  return displacement > rounded_place * size ? error / displacement : error;
}

Trace measure_once(const pbd::Scene& scene, const pbd::State& state, double h, const pbd::Method& method,
                   const pbd::Points& exact, const pbd::Workspace* before) {
  Trace trace;
  const pbd::Points begin = places(scene, state.x, state.orientation);
  pbd::Bodies bodies(scene);
  pbd::Points x, v;
  bodies.begin(state, x, v);
  const auto error_of = [&](const pbd::State& at) {
    return relative_error(places(scene, at.x, at.orientation), exact, begin);
  };
  const pbd::Integrator& integrator = pbd::find_named(pbd::integrators(), "integrator", method.integrator);
  const double extension = integrator.coefficients({method, h, pbd::infinity, true}).extension;
  const auto carried_on = [&](const pbd::Points& from, const pbd::Points& to) {
    return extension == 1 ? to : pbd::Points(from + extension * (to - from));
  };
  pbd::State reached = state;
  Clock::duration watching{0};
  const auto start = Clock::now();
  pbd::Workspace workspace(scene, method);
  if (before != nullptr) workspace.go_on_from(*before);
  pbd::State end = state;
  const auto observe = [&](const pbd::Iterate& iterate) {
    const auto entered = Clock::now();
    throw_if_interrupted();
    const double residual = pbd::larger(iterate.primal, iterate.dual);
    bodies.end(carried_on(x, iterate.x), carried_on(v, iterate.v), reached);
    trace.points.push_back({iterate.outer_iteration, iterate.sweeps, iterate.row_updates,
                            seconds(entered - start - watching), error_of(reached),
                            iterate.scale > 0 ? residual / iterate.scale : residual});
    watching += Clock::now() - entered;
  };
  trace.report = pbd::step(workspace, h, end, observe);
  const double wall = seconds(Clock::now() - start - watching);
  const auto contacts = workspace.contacts();
  trace.met_on_way = std::any_of(contacts.begin(), contacts.end(),
                                 [](const auto& each) { return each.met && !each.force.isZero(0); });
  const pbd::Report& report = trace.report;
  if (trace.points.empty() || trace.points.back().outer_iterations != report.outer_iterations)
    trace.points.push_back(
        {.outer_iterations = report.outer_iterations, .error = error_of(end), .residual = report.residual()});
  TracePoint& last = trace.points.back();  // with what the step does after its last iterate
  last.sweeps = report.sweeps;
  last.row_updates = report.row_updates;
  last.wall_s = wall;
  return trace;
}

Trace measure_once(const pbd::Scene& scene, const pbd::State& state, double h,
                   const pbd::rivals::NamedRival& rival, const pbd::rivals::Budget& budget,
                   const pbd::Points& exact) {
  Trace trace;
  const auto start = Clock::now();
  const auto made = rival.make(scene, h);
  const double making = seconds(Clock::now() - start);
  pbd::State end = state;
  trace.report = report_of(made->step(end, budget, [&](const pbd::rivals::Iterate& iterate) {
    throw_if_interrupted();
    trace.points.push_back({.outer_iterations = iterate.iteration,
                            .wall_s = making + iterate.seconds,
                            .error = relative_error(iterate.x, exact, state.x),
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
