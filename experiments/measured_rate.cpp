#include "measured_rate.h"

#include <cmath>

#include "step.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr double begin = 1e-6;  // error that an iteration starts with, of the step

/// The same step, started with another old velocity.
struct Moved {
  Scene scene;
  State start;
};

/// Forces that keep v_free where it is although the old velocities become those of `start` + `change`.
ExternalForce compensation(const Scene& scene, const Points& change, double h) {
  ExternalForce effect;
  for (int node = 0; node < scene.nodes(); ++node)
    if (const double mass = scene.mass[static_cast<std::size_t>(node)]; std::isfinite(mass)) {
      effect.node.push_back(node);
      effect.force.emplace_back(-mass / h * change.col(node));
    }
  return effect;
}

Points without_symmetry(const Scene& scene) {
  Points direction(3, scene.nodes());
  for (Eigen::Index k = 0; k < direction.size(); ++k)
    direction.reshaped()[k] = std::sin(3 * static_cast<double>(k) + 1);
  return direction;
}

double change_of(const State& start, const reference::Judgement& solved) {
  return (solved.v - start.v).norm();
}

/// The step with its first iterate beside the solution, along `direction`.
Moved beside(const Scene& scene, const State& start, double h, const reference::Judgement& solved,
             const Points& direction) {
  Moved moved{scene, start};
  moved.start.v = solved.v + begin * change_of(start, solved) / direction.norm() * direction;
  for (int node = 0; node < scene.nodes(); ++node)
    if (!std::isfinite(scene.mass[static_cast<std::size_t>(node)]))
      moved.start.v.col(node) = start.v.col(node);
  moved.scene.effects.emplace_back(compensation(scene, moved.start.v - start.v, h));
  return moved;
}

Method plain(int iterations, double tolerance) {
  Method method;
  method.outer = "plain";
  method.relaxation = "direct";
  method.tolerance = tolerance;
  method.max_outer = iterations;
  return method;
}

}  // namespace

double measured_rate(const Scene& scene, const State& start, double h, const reference::Judgement& solved) {
  constexpr double end = 1e-10, settled = 1e-3;
  constexpr int fewest_restarts = 8, most_restarts = 40, most_iterations = 400;
  const Method method = plain(most_iterations, 1e-15);
  const double scale = change_of(start, solved);
  Points direction = without_symmetry(scene);
  double last_rate = 0, last_mean = 0;
  for (int restart = 0; restart < most_restarts; ++restart) {
    Moved moved = beside(scene, start, h, solved, direction);
    Workspace workspace(moved.scene, method);
    double last = begin;
    int iterations = 0;
    step(moved.scene, method, h, moved.start, workspace, [&](const Iterate& iterate) {
      const Points error = iterate.v.leftCols(solved.v.cols()) - solved.v;  // of the nodes
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

bool plain_returns(const Scene& scene, const State& start, double h, const reference::Judgement& solved,
                   int iterations) {
  const Method method = plain(iterations, 1e-12);
  Moved moved = beside(scene, start, h, solved, without_symmetry(scene));
  Workspace workspace(moved.scene, method);
  return step(moved.scene, method, h, moved.start, workspace).status == Status::ok;
}

}  // namespace pbdcheck
