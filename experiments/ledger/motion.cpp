#include "ledger/motion.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/interrupt.h"
#include "numerics.h"

namespace pbdcheck::ledger {

using namespace pbd;

Method direct_method(std::string_view integrator) {
  Method method;
  method.integrator = integrator;
  method.relaxation = "direct";
  method.tolerance = 1e-12;
  return method;
}

void add_links(Scene& scene, double length) {
  Distance links;
  for (int i = 1; i < scene.nodes(); ++i) {
    links.node.push_back({i - 1, i});
    links.rest_length.push_back(length);
    links.compliance.push_back(0);
  }
  scene.effects.emplace_back(Gravity{});
  scene.effects.emplace_back(std::move(links));
}

Motion::Motion(const Scene& scene, const Method& method) : workspace(scene, method), state(scene.initial) {}

void Motion::advance(double h, std::int64_t steps) {
  for (std::int64_t k = 0; k < steps; ++k) {
    throw_if_interrupted();
    const Report report = step(workspace, h, state);
    if (report.status != Status::ok)
      throw std::runtime_error(fmt::format("the step from {:.6g} s is {}: {} (residual {:.2g})", state.time,
                                           status_names[static_cast<std::size_t>(report.status)],
                                           report.reason, report.residual()));
  }
}

State state_after(const Scene& scene, const Method& method, double h, std::int64_t steps) {
  Motion motion(scene, method);
  motion.advance(h, steps);
  return motion.state;
}

State equilibrium(Motion& motion, double h) {
  const double still = motion.workspace.method().tolerance;  // of the largest coordinate
  constexpr int most = 1000;
  int resting = 0;  // steps in a row: a motion that turns may rest for one
  for (int k = 0; k < most; ++k) {
    const Points before = motion.state.x;
    motion.advance(h);
    const double moved = (motion.state.x - before).cwiseAbs().maxCoeff();
    resting = moved <= still * motion.state.x.cwiseAbs().maxCoeff() ? resting + 1 : 0;
    if (resting == 2) return motion.state;
  }
  throw std::runtime_error(fmt::format("no equilibrium after {} steps of {:g} s", most, h));
}

State equilibrium(const Scene& scene, const Method& method, double h) {
  Motion motion(scene, method);
  return equilibrium(motion, h);
}

void calm(Motion& motion, double first, double h) {
  for (double step = first; step < h; step *= 1.1) motion.advance(step);
}

double passage(const Scene& scene, const Method& method, double h, const Observable& value,
               const Observable& rate, double latest, int n) {
  Motion motion(scene, method);
  double before = value(motion.state), slope = rate(motion.state);
  while (motion.state.time < latest) {
    const double start = motion.state.time;
    motion.advance(h);
    const double after = value(motion.state), end_slope = rate(motion.state);
    if (before * after < 0 && --n == 0) {
      const auto cubic = [&](double t) {
        const double u = 1 - t;
        return before * u * u * (1 + 2 * t) + h * slope * t * u * u + after * t * t * (3 - 2 * t) -
               h * end_slope * t * t * u;
      };
      return start + h * reference::find_root(cubic, 0, 1);
    }
    before = after, slope = end_slope;
  }
  throw std::runtime_error(fmt::format("no passage within {:g} s", latest));
}

double extrapolated(const std::function<double(double h)>& f, double h, int order) {
  const double coarse = f(h), fine = f(h / 2);
  return fine + (fine - coarse) / (std::pow(2, order) - 1);
}

double threshold(double low, double high, double resolution, const std::function<bool(double)>& holds) {
  for (const double end : {low, high})
    if (holds(end) != (end == high))
      throw std::runtime_error(fmt::format("it {} at {:.6g}", end == high ? "fails" : "holds", end));
  while (high - low > resolution) {
    const double middle = (low + high) / 2;
    (holds(middle) ? high : low) = middle;
  }
  return (low + high) / 2;
}

double slowest_frequency(const Scene& scene, const Method& method, double h, int settling,
                         const Observable& value) {
  Motion motion(scene, method);
  motion.advance(h, settling);
  std::array<double, 3> q{};
  for (double& each : q) {
    motion.advance(h);
    each = value(motion.state);
  }
  const double square = (2 * q[1] - q[0]) / q[2] - 1;
  return std::sqrt(square) / (2 * std::numbers::pi * h);
}

double turning_rate(const Vec3& axis, const Vec3& before, const Vec3& after, double time) {
  return std::atan2(axis.dot(before.cross(after)), before.dot(after) - axis.dot(before) * axis.dot(after)) /
         time;
}

}  // namespace pbdcheck::ledger
