// A damped oscillator q'' = -w^2 (q + T q') as a link along x, and what a run of it says of a step.
#pragma once

#include <catch2/catch.hpp>
#include <vector>

#include "oscillator_rules.h"
#include "step/step.h"

namespace pbd::test {

/// 1 kg on a link of rest length 1 m along x, `stretch` m beyond it, that makes it a spring of w rad/s.
inline Scene spring(double w, double stretch, double damping_s = 0) {
  Scene scene;
  add_node(scene, Vec3::Zero(), infinity);
  add_node(scene, Vec3(1 + stretch, 0, 0), 1);
  Distance link{.node = {{0, 1}}, .rest_length = {1}, .compliance = {1 / (w * w)}};
  if (damping_s > 0) link.damping = {damping_s};
  scene.effects.emplace_back(std::move(link));
  return scene;
}

inline Method method_of(std::string_view integrator, double tolerance = 1e-13) {
  Method method;
  method.integrator = integrator;
  method.relaxation = "direct";
  method.tolerance = tolerance;
  return method;
}

/// r and phi of a sequence q_l+1 = 2 r cos(phi) q_l - r^2 q_l-1, from four values of q in a row.
inline reference::Discrete measured(const std::vector<double>& q) {
  const double square = (q[3] * q[1] - q[2] * q[2]) / (q[2] * q[0] - q[1] * q[1]);
  return {std::sqrt(square), std::acos((q[3] + square * q[1]) / (2 * std::sqrt(square) * q[2]))};
}

/// The same of a run, after `settled` steps, in which the second root of a two-step rule dies out.
inline reference::Discrete measured(const Scene& scene, const Method& method, double h, int settled) {
  Workspace workspace(scene, method);
  State state = scene.initial;
  std::vector<double> q;
  for (int k = 0; k < settled + 4; ++k) {
    CHECK(step(workspace, h, state).status == Status::ok);
    if (k >= settled) q.push_back(state.x(0, 1) - 1);
  }
  return measured(q);
}

}  // namespace pbd::test
