#include "studies/iteration/measured_rate.h"

#include <cmath>

#include "contraction.h"
#include "step/step.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr double begin = 1e-6;  // error that an iteration starts with, of the step

/// The same step, started with another old velocity.
struct Moved {
  Scene scene;
  State start;
};

/// Velocities of all columns as the solver has them: nodes', then bodies' rotations in radii of gyration
/// (m/s).
Points rate_columns(const Scene& scene, const Points& v, const Points& spin) {
  Points all(3, v.cols() + spin.cols());
  all << v, spin;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const auto& [node, inertia] = scene.bodies[b];
    if (inertia.allFinite())
      all.col(v.cols() + static_cast<Eigen::Index>(b)).array() *=
          (inertia / scene.mass[static_cast<std::size_t>(node)]).array().sqrt();
  }
  return all;
}

/// Forces and torques that keep v_free where it is although the old velocities become those of `moved`.
void compensate(Moved& moved, const State& start, double h) {
  ExternalForce force;
  ExternalTorque torque;
  for (int node = 0; node < moved.scene.nodes(); ++node)
    if (const double mass = moved.scene.mass[static_cast<std::size_t>(node)]; std::isfinite(mass)) {
      force.node.push_back(node);
      force.force.emplace_back(-mass / h * (moved.start.v.col(node) - start.v.col(node)));
    }
  for (int b = 0; b < static_cast<int>(moved.scene.bodies.size()); ++b)
    if (const auto& [node, inertia] = moved.scene.bodies[static_cast<std::size_t>(b)]; inertia.allFinite()) {
      const Vec3 change = moved.start.spin.col(b) - start.spin.col(b);
      torque.body.push_back(b);
      torque.torque.emplace_back(start.orientation[static_cast<std::size_t>(b)] *
                                 Vec3(-inertia.cwiseProduct(change) / h));
    }
  moved.scene.effects.emplace_back(force);
  moved.scene.effects.emplace_back(torque);
}

Points without_symmetry(const Scene& scene) {
  Points direction(3, scene.nodes() + std::ssize(scene.bodies));
  for (Eigen::Index k = 0; k < direction.size(); ++k)
    direction.reshaped()[k] = std::sin(3 * static_cast<double>(k) + 1);
  return direction;
}

double change_of(const Scene& scene, const State& start, const reference::Judgement& solved) {
  return rate_columns(scene, solved.v - start.v, solved.spin - start.spin).norm();
}

/// The step with its first iterate beside the solution, along `direction` of all columns.
Moved beside(const Scene& scene, const State& start, double h, const reference::Judgement& solved,
             const Points& direction) {
  Moved moved{scene, start};
  const double length = begin * change_of(scene, start, solved) / direction.norm();
  const Points unit =
      rate_columns(scene, Points::Ones(3, scene.nodes()), Points::Ones(3, solved.spin.cols()));
  const Points away = length * direction.cwiseQuotient(unit);
  moved.start.v = solved.v + away.leftCols(scene.nodes());
  moved.start.spin = solved.spin + away.rightCols(solved.spin.cols());
  for (int node = 0; node < scene.nodes(); ++node)
    if (!std::isfinite(scene.mass[static_cast<std::size_t>(node)]))
      moved.start.v.col(node) = start.v.col(node);
  for (int b = 0; b < static_cast<int>(scene.bodies.size()); ++b)
    if (!scene.bodies[static_cast<std::size_t>(b)].inertia.allFinite())
      moved.start.spin.col(b) = start.spin.col(b);
  compensate(moved, start, h);
  return moved;
}

/// Linear problems are solved to the end: what is left of them would count as error of the iteration.
Method plain(int iterations, double tolerance, std::string_view friction) {
  Method method;
  method.outer = "plain";
  method.relaxation = "direct";
  method.friction = friction;
  method.inner_tolerance = 1e-9;
  method.tolerance = tolerance;
  method.max_outer = iterations;
  return method;
}

}  // namespace

double distance_from(const Scene& scene, const State& start, const reference::Judgement& solved,
                     const State& end) {
  return rate_columns(scene, end.v - solved.v, end.spin - solved.spin).norm() /
         change_of(scene, start, solved);
}

double measured_rate(const Scene& scene, const State& start, double h, const reference::Judgement& solved) {
  constexpr double end = 1e-10, settled = 1e-3;
  constexpr int fewest_restarts = 8, most_restarts = 40, most_iterations = 400;
  const Method method = plain(most_iterations, 1e-15, "coulomb");
  const double scale = change_of(scene, start, solved);
  const Points end_velocities = rate_columns(scene, solved.v, solved.spin);
  Points direction = without_symmetry(scene);
  double last_rate = 0, last_mean = 0;
  for (int restart = 0; restart < most_restarts; ++restart) {
    Moved moved = beside(scene, start, h, solved, direction);
    Workspace workspace(moved.scene, method);
    double last = begin;
    int iterations = 0;
    step(workspace, h, moved.start, [&](const Iterate& iterate) {
      const Points error = iterate.v - end_velocities;
      if (iterate.outer_iteration == 0 || last < end) return;
      last = error.norm() / scale;
      direction = error;
      ++iterations;
    });
    if (!(last < begin)) return std::nan("");
    const double rate = std::pow(last / begin, 1.0 / iterations);
    const double mean = std::sqrt(rate * last_rate);
    if (last == 0) return 0;
    if (restart >= fewest_restarts && mean < least_rate) return 0;
    if (restart >= fewest_restarts && std::abs(mean / last_mean - 1) < settled) return mean;
    last_rate = rate;
    last_mean = mean;
  }
  return std::nan("");
}

double measured_map_rate(const Scene& scene, const State& start, double h, const reference::Judgement& solved,
                         std::string_view friction) {
  const Method method = plain(2, 1e-15, friction);  // the second begins where the first one ends
  const Points none = Points::Zero(3, scene.nodes() + std::ssize(scene.bodies));
  const auto size = none.size();
  const auto ends = [&](Eigen::Index entry, double sign) {
    Points direction = none, end = none;
    direction.reshaped()[entry] = sign;
    Moved moved = beside(scene, start, h, solved, direction);
    Workspace workspace(moved.scene, method);
    step(workspace, h, moved.start, [&](const Iterate& iterate) {
      if (iterate.outer_iteration == 1) end = iterate.v;
    });
    return end;
  };
  const double apart = 2 * begin * change_of(scene, start, solved);
  Eigen::MatrixXd map(size, size);
  for (Eigen::Index entry = 0; entry < size; ++entry)
    map.col(entry) = (ends(entry, 1) - ends(entry, -1)).reshaped() / apart;
  return reference::extremes(map).radius();
}

bool plain_returns(const Scene& scene, const State& start, double h, const reference::Judgement& solved,
                   int iterations, std::string_view friction) {
  const Method method = plain(iterations, 1e-12, friction);
  Moved moved = beside(scene, start, h, solved, without_symmetry(scene));
  Workspace workspace(moved.scene, method);
  return step(workspace, h, moved.start).status == Status::ok &&
         distance_from(scene, start, solved, moved.start) < begin;
}

}  // namespace pbdcheck
