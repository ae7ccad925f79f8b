#include "ode.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "assembly.h"
#include "planar_chain.h"

namespace pbd::reference {
namespace {

/// First-order form of a motion, y = (coordinates, their rates), and the state of all nodes at y.
struct Motion {
  Vector start;
  Slope slope;
  std::function<State(double time, const Vector& y)> state;
};

Motion compliant_motion(const Scene& scene, const Model& model) {
  const int n = model.unknowns;
  Points drift = Points::Zero(3, scene.nodes());  // velocities of nodes of infinite mass
  for (int a = 0; a < scene.nodes(); ++a)
    if (model.first[static_cast<std::size_t>(a)] < 0) drift.col(a) = scene.initial.v.col(a);
  const auto positions = [&scene, &model, drift, n](double t, const Vector& y) {
    return scatter(model, scene.initial.x + t * drift, y.head(n));
  };
  Motion motion;
  motion.start.resize(2 * n);
  motion.start << gather(model, scene.initial.x), gather(model, scene.initial.v);
  motion.slope = [&model, positions, n](double t, const Vector& y, Vector& slope) {
    slope.head(n) = y.tail(n);
    slope.tail(n) = (model.force - energy_gradient(model, positions(t, y))).cwiseQuotient(model.mass);
  };
  motion.state = [&scene, &model, positions, n](double t, const Vector& y) {
    return State{scene.initial.time + t, positions(t, y), scatter(model, scene.initial.v, y.tail(n))};
  };
  return motion;
}

Motion chain_motion(const Scene& scene) {
  const HungChain hung = hung_chain(scene);
  const int n = hung.chain.links();
  Motion motion;
  motion.start.resize(2 * n);
  motion.start << hung.angle, hung.rate;
  motion.slope = [hung, n](double, const Vector& y, Vector& slope) {
    slope.head(n) = y.tail(n);
    slope.tail(n) = hung.chain.acceleration(y.head(n), y.tail(n));
  };
  motion.state = [&scene, hung, n](double t, const Vector& y) {
    return hung.state(scene.initial, t, y.head(n), y.tail(n));
  };
  return motion;
}

double largest_distance(const Points& a, const Points& b) {
  return (a - b).colwise().norm().maxCoeff();
}

std::optional<double> energy_drift(const Scene& scene, const Model& model,
                                   const std::vector<State>& samples) {
  for (int a = 0; a < scene.nodes(); ++a)
    if (model.first[static_cast<std::size_t>(a)] < 0 && !scene.initial.v.col(a).isZero(0))
      return std::nullopt;
  const Vector start = gather(model, scene.initial.x);
  double drift = 0, scale = 0;
  std::optional<double> first;
  const auto add = [&](const State& state) {
    const double kinetic = gather(model, state.v).cwiseAbs2().dot(model.mass) / 2;
    const double potential = lagrangian(model, state.x, {}) - model.force.dot(gather(model, state.x) - start);
    if (!first) first = kinetic + potential;
    drift = std::max(drift, std::abs(kinetic + potential - *first));
    scale = std::max(scale, kinetic + std::abs(potential));
  };
  add(scene.initial);
  for (const State& state : samples) add(state);
  return scale > 0 ? drift / scale : 0;
}

}  // namespace

Trajectory ode(const Scene& scene, const std::vector<double>& times, const OdeSettings& settings) {
  const auto begin = std::chrono::steady_clock::now();
  const Model model = make_model(scene);
  const Motion motion = model.hard_rows == 0 ? compliant_motion(scene, model) : chain_motion(scene);
  Trajectory trajectory;
  try {
    const OdeSolution fine = solve_ode(motion.slope, motion.start, times, settings);
    OdeSettings looser = settings;
    looser.tolerance *= 100;
    const OdeSolution coarse = solve_ode(motion.slope, motion.start, times, looser);
    for (std::size_t i = 0; i < times.size(); ++i) {
      const State a = motion.state(times[i], fine.states[i]), b = motion.state(times[i], coarse.states[i]);
      trajectory.position_error.push_back(largest_distance(a.x, b.x));
      trajectory.velocity_error.push_back(largest_distance(a.v, b.v));
      trajectory.samples.push_back(a);
    }
    trajectory.evaluations = fine.evaluations;
    trajectory.energy_drift = energy_drift(scene, model, trajectory.samples);
    trajectory.outcome = Outcome::ok;
  } catch (const OdeFailure& failure) {
    trajectory.reason = failure.what();
  }
  trajectory.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return trajectory;
}

}  // namespace pbd::reference
