#include "ode.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "assembly.h"
#include "planar_chain.h"
#include "rigid_motion.h"

namespace pbd::reference {
namespace {

/// First-order form of a motion, y = (coordinates, their rates), and the state of all nodes at y.
struct Motion {
  Vector start;
  Slope slope;
  std::function<State(double time, const Vector& y)> state;
  std::function<Energy(const State&)> energy;  // empty where forces without potential do work
  std::function<Drift(const State&)> drift{};  // empty where no constraint can drift
  std::function<bool()> singular{};  // whether it passed a place where constraints change their rank
};

/// Energy of nodes; none where supports move.
std::function<Energy(const State&)> node_energy(const Scene& scene, const Model& model) {
  for (int a = 0; a < scene.nodes(); ++a)
    if (model.first[a] < 0 && !scene.initial.v.col(a).isZero(0)) return {};
  return [&model, start = gather(model, scene.initial.x)](const State& state) -> Energy {
    const double kinetic = gather(model, state.v).cwiseAbs2().dot(model.mass) / 2;
    const double potential = lagrangian(model, state.x, {}) - model.force.dot(gather(model, state.x) - start);
    return {kinetic + potential, kinetic + std::abs(potential)};
  };
}

Motion compliant_motion(const Scene& scene, const Model& model) {
  const int n = model.unknowns;
  Points drift = Points::Zero(3, scene.nodes());  // velocities of nodes of infinite mass
  for (int a = 0; a < scene.nodes(); ++a)
    if (model.first[a] < 0) drift.col(a) = scene.initial.v.col(a);
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
  motion.energy = node_energy(scene, model);
  return motion;
}

Motion chain_motion(const Scene& scene, const Model& model) {
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
  motion.energy = node_energy(scene, model);
  return motion;
}

Motion rigid_motion(const Scene& scene) {
  const auto rigid = std::make_shared<const RigidMotion>(scene);
  Motion motion;
  motion.start = rigid->start();
  motion.slope = [rigid](double t, const Vector& y, Vector& slope) { rigid->slope(t, y, slope); };
  motion.state = [rigid](double t, const Vector& y) { return rigid->state(t, y); };
  if (rigid->conservative()) motion.energy = [rigid](const State& state) { return rigid->energy(state); };
  motion.drift = [rigid](const State& state) { return rigid->drift(state); };
  motion.singular = [rigid] { return rigid->rank_changed(); };
  return motion;
}

double largest_distance(const Points& a, const Points& b) {
  return a.cols() == 0 ? 0 : (a - b).colwise().norm().maxCoeff();
}

double largest_angle(const State& a, const State& b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.orientation.size(); ++k)
    largest = std::max(largest, a.orientation[k].angularDistance(b.orientation[k]));
  return largest;
}

double energy_drift(const Motion& motion, const State& initial, const std::vector<State>& samples) {
  const Energy first = motion.energy(initial);
  double drift = 0, scale = first.size;
  for (const State& state : samples) {
    const Energy energy = motion.energy(state);
    drift = std::max(drift, std::abs(energy.value - first.value));
    scale = std::max(scale, energy.size);
  }
  return scale > 0 ? drift / scale : 0;
}

/// Why the constraints of a motion are not to be trusted, or nothing.
std::string measure_drift(const Motion& motion, Trajectory& trajectory) {
  if (!motion.drift) return {};
  trajectory.position_drift = trajectory.velocity_drift = 0;
  double claimed = 0;
  std::string reason;
  for (std::size_t i = 0; i < trajectory.samples.size(); ++i) {
    const State& state = trajectory.samples[i];
    const Drift drift = motion.drift(state);
    claimed = std::max(claimed, trajectory.position_error[i]);
    *trajectory.position_drift = std::max(*trajectory.position_drift, drift.position);
    *trajectory.velocity_drift = std::max(*trajectory.velocity_drift, drift.velocity);
    constexpr double rounding = 1e-12;
    if (reason.empty() && !(drift.position <= 10 * claimed + rounding * (1 + state.x.cwiseAbs().maxCoeff())))
      reason = "ode: constraints drift beyond the errors before t = " + std::to_string(state.time) + " s";
  }
  if (motion.singular()) reason = "ode: constraints change their rank on the way";
  return reason;
}

/// Both runs' samples and what they differ by.
void integrate_twice(const Motion& motion, const std::vector<double>& times, const OdeSettings& settings,
                     Trajectory& trajectory) {
  const OdeSolution fine = solve_ode(motion.slope, motion.start, times, settings);
  OdeSettings looser = settings;
  looser.tolerance *= 100;
  const OdeSolution coarse = solve_ode(motion.slope, motion.start, times, looser);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const State a = motion.state(times[i], fine.states[i]), b = motion.state(times[i], coarse.states[i]);
    trajectory.position_error.push_back(largest_distance(a.x, b.x));
    trajectory.velocity_error.push_back(largest_distance(a.v, b.v));
    if (!a.orientation.empty()) {
      trajectory.orientation_error.push_back(largest_angle(a, b));
      trajectory.spin_error.push_back(largest_distance(a.spin, b.spin));
    }
    trajectory.samples.push_back(a);
  }
  trajectory.evaluations = fine.evaluations;
}

Motion motion_of(const Scene& scene, const Model& model) {
  return model.hard_rows == 0 ? compliant_motion(scene, model) : chain_motion(scene, model);
}

}  // namespace

Trajectory ode(const Scene& scene, const std::vector<double>& times, const OdeSettings& settings) {
  const auto begin = std::chrono::steady_clock::now();
  const Model model = scene.bodies.empty() ? make_model(scene) : Model();
  const Motion motion = scene.bodies.empty() ? motion_of(scene, model) : rigid_motion(scene);
  Trajectory trajectory;
  try {
    integrate_twice(motion, times, settings, trajectory);
    if (motion.energy) trajectory.energy_drift = energy_drift(motion, scene.initial, trajectory.samples);
    trajectory.reason = measure_drift(motion, trajectory);
    trajectory.outcome = trajectory.reason.empty() ? Outcome::ok : Outcome::not_converged;
    if (trajectory.outcome != Outcome::ok) trajectory.samples.clear();
  } catch (const OdeFailure& failure) {
    trajectory.reason = failure.what();
  }
  trajectory.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return trajectory;
}

}  // namespace pbd::reference
