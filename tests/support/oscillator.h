// A damped oscillator q'' = -w^2 (q + T q') as a link along x, and what a step of each integrator makes of
// it: its matrix has the eigenvalues r exp(+-i phi), closed forms of z = h mu, mu^2 + w^2 T mu + w^2 = 0.
#pragma once

#include <catch2/catch.hpp>
#include <complex>
#include <vector>

#include "step.h"

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

struct PerStep {
  double growth;  // r
  double turn;    // phi, rad
};

inline std::complex<double> eigenvalue(double w, double damping_s) {
  const double decay = w * w * damping_s / 2;
  return {-decay, std::sqrt(w * w - decay * decay)};
}

inline PerStep per_step(std::complex<double> root) {
  return {std::abs(root), std::abs(std::arg(root))};
}

inline PerStep theta_rule(double alpha, double h, double w, double damping_s) {
  const auto z = h * eigenvalue(w, damping_s);
  return per_step((1.0 + (1 - alpha) * z) / (1.0 - alpha * z));
}
inline PerStep implicit_euler_rule(double h, double w, double damping_s) {
  return theta_rule(1, h, w, damping_s);
}
inline PerStep trapezoidal_rule(double h, double w, double damping_s) {
  return theta_rule(0.5, h, w, damping_s);
}
inline PerStep damped_trapezoidal_rule(double h, double w, double damping_s) {
  return theta_rule(0.55, h, w, damping_s);
}
inline PerStep bdf2_rule(double h, double w, double damping_s) {
  const auto z = h * eigenvalue(w, damping_s);
  return per_step((2.0 + std::sqrt(1.0 + 2.0 * z)) / (3.0 - 2.0 * z));
}
/// v' = v - h w^2 (q + T v), q' = q + h v': the matrix has the determinant 1 - h w^2 T.
inline PerStep symplectic_euler_rule(double h, double w, double damping_s) {
  const double square = 1 - h * w * w * damping_s;
  return {std::sqrt(square), std::acos((1 + square - h * h * w * w) / (2 * std::sqrt(square)))};
}

/// r and phi of a sequence q_l+1 = 2 r cos(phi) q_l - r^2 q_l-1, from four values of q in a row.
inline PerStep measured(const std::vector<double>& q) {
  const double square = (q[3] * q[1] - q[2] * q[2]) / (q[2] * q[0] - q[1] * q[1]);
  return {std::sqrt(square), std::acos((q[3] + square * q[1]) / (2 * std::sqrt(square) * q[2]))};
}

/// The same of a run, after `settled` steps, in which the second root of a two-step rule dies out.
inline PerStep measured(const Scene& scene, const Method& method, double h, int settled) {
  Workspace workspace(scene, method);
  State state = scene.initial;
  std::vector<double> q;
  for (int k = 0; k < settled + 4; ++k) {
    CHECK(step(scene, method, h, state, workspace).status == Status::ok);
    if (k >= settled) q.push_back(state.x(0, 1) - 1);
  }
  return measured(q);
}

/// An integrator with its rule; alpha is newmark's.
struct KnownRule {
  std::string_view integrator;
  double alpha;
  PerStep (*rule)(double h, double w, double damping_s);
  int settled = 0;
};
inline const std::vector<KnownRule> known_rules{{"implicit_euler", 0.55, implicit_euler_rule},
                                                {"newmark", 1, implicit_euler_rule},
                                                {"newmark", 0.5, trapezoidal_rule},
                                                {"newmark", 0.55, damped_trapezoidal_rule},
                                                {"midpoint", 0.55, trapezoidal_rule},
                                                {"bdf2", 0.55, bdf2_rule, 40},
                                                {"symplectic_euler", 0.55, symplectic_euler_rule}};

}  // namespace pbd::test
