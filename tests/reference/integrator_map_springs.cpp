// Steps of damped springs by integrators other than implicit Euler, each from its own formulas.
#include <catch2/catch.hpp>
#include <cmath>

#include "damping.h"
#include "integrator_map.h"
#include "judged_contact.h"
#include "step_equations.h"

using namespace pbd;
using namespace pbd::reference;
using namespace pbd::test;

namespace {

constexpr double rate = 30, retardation = 0.01, stretch = 0.2, speed = 3;  // rad/s, s, m, m/s

/// 1 kg on a damped link of 1 m along x that begins longer than it is.
Scene damped_spring() {
  Scene scene;
  add_node(scene, Vec3::Zero(), infinity);
  add_node(scene, Vec3(1 + stretch, 0, 0), 1);
  scene.effects.emplace_back(Distance{
      .node = {{0, 1}}, .rest_length = {1}, .compliance = {1 / (rate * rate)}, .damping = {retardation}});
  return scene;
}

Method method_of(const std::string& integrator) {
  Method method;
  method.integrator = integrator;
  return method;
}

/// x'' = q(x, x') of a mass of 1 kg on the spring, and where a step of h seconds begins; h_l the step before.
struct Spring {
  double x, v, q, a, h, h_l;

  static double force(double x, double v) { return -rate * rate * (x + retardation * v); }
  double carried() const { return h_l > 0 ? q + h / h_l * (a - q) : a; }
};

/// x = from_x + of_x y, v = from_v + of_v y and q(x, v) = from_q + of_q y are linear in y: the y that solves
/// them, and the end.
Spring solved(const Spring& start, double from_x, double of_x, double from_v, double of_v, double from_q,
              double of_q) {
  const double y =
      (Spring::force(from_x, from_v) - from_q) / (of_q + rate * rate * (of_x + retardation * of_v));
  const double x = from_x + of_x * y, v = from_v + of_v * y;
  return {x, v, Spring::force(x, v), y, start.h, start.h};
}

Spring euler(const Spring& s) {  // y = q
  return solved(s, s.x + s.h * s.v, s.h * s.h, s.v, s.h, 0, 1);
}

Spring newmark_by_alpha(const Spring& s, double alpha) {  // y = q
  const double from_v = s.v + s.h * (1 - alpha) * s.q;
  return solved(s, s.x + s.h * ((1 - alpha) * s.v + alpha * from_v), s.h * s.h * alpha * alpha, from_v,
                s.h * alpha, 0, 1);
}

/// y = a, (1 - m) a + m a_l = (1 - f) q + f q_l.
Spring by_accelerations(const Spring& s, double m, double f, double beta, double gamma) {
  const double a = s.carried(), h = s.h;
  return solved(s, s.x + h * s.v + h * h * (0.5 - beta) * a, h * h * beta, s.v + h * (1 - gamma) * a,
                h * gamma, (m * a - f * s.q) / (1 - f), (1 - m) / (1 - f));
}

Spring generalised_alpha(const Spring& s, double rho) {
  const double m = (2 * rho - 1) / (rho + 1), f = rho / (rho + 1), gamma = 0.5 + f - m;
  return by_accelerations(s, m, f, (gamma + 0.5) * (gamma + 0.5) / 4, gamma);
}

Spring bdf2(const Spring& s, const Spring& last) {  // y = q
  if (!(s.h_l > 0)) return euler(s);
  const double w = s.h / s.h_l, share = w * w / (1 + 2 * w), d = s.h * (1 + w) / (1 + 2 * w);
  const double from_v = s.v + share * (s.v - last.v);
  return solved(s, s.x + share * (s.x - last.x) + d * from_v, d * d, from_v, d, 0, 1);
}

Spring midpoint(const Spring& s) {  // y = q in the middle
  const double half = s.h / 2;
  const Spring middle = solved(s, s.x + half * s.v, half * half, s.v, half, 0, 1);
  return {2 * middle.x - s.x, 2 * middle.v - s.v, 0, 0, s.h, s.h};
}

State state_of(const Scene& scene, const Spring& s, double time) {
  State state = scene.initial;
  state.time = time;
  state.x(0, 1) = 1 + s.x;
  state.v(0, 1) = s.v;
  return state;
}

/// Follows the spring through steps of changing length.
template <class Rule>
void check_steps(const Method& method, Rule&& rule) {
  INFO(method.integrator << " alpha " << method.alpha << " rho " << method.rho);
  const Scene scene = damped_spring();
  IntegratorMemory memory(method);
  Spring last{}, now{stretch, speed, Spring::force(stretch, speed), Spring::force(stretch, speed), 0, 0};
  double time = 0;
  for (const double h : {0.01, 0.01, 0.015, 0.01}) {
    now.h = h;
    const Spring next = rule(now, last);
    const State start = state_of(scene, now, time), end = state_of(scene, next, time + h);
    const auto map = memory.smooth_map(scene, start, h);
    const auto j = contact_newton(scene, start, h, Friction::coulomb, cone_interior_point,
                                  {.map = map ? &*map : nullptr});
    CHECK(j.outcome == Outcome::ok);
    CHECK(std::abs(j.v(0, 1) - next.v) <= by_hand);
    CHECK(std::abs(j.x(0, 1) - 1 - next.x) <= by_hand * h);
    StepClaim claim{.scene = scene, .start = start, .end = end, .h = h, .integrator = method.integrator};
    memory.follow(claim);
    time += h;
    last = now;
    now = next;
  }
}

}  // namespace

TEST_CASE("damped springs go by Newmark's rule for every alpha") {
  for (const double alpha : {0.5, 0.7, 1.0}) {
    Method method = method_of("newmark");
    method.alpha = alpha;
    check_steps(method, [&](const Spring& s, const Spring&) { return newmark_by_alpha(s, alpha); });
  }
}

TEST_CASE("damped springs go by Newmark's own family") {
  Method method = method_of("newmark");
  method.beta = 0.3;
  method.gamma = 0.6;
  check_steps(method, [](const Spring& s, const Spring&) { return by_accelerations(s, 0, 0, 0.3, 0.6); });
}

TEST_CASE("damped springs that move go by generalised alpha from their first step on") {
  for (const double rho : {0.0, 0.5, 0.8}) {
    Method method = method_of("generalised_alpha");
    method.rho = rho;
    check_steps(method, [&](const Spring& s, const Spring&) { return generalised_alpha(s, rho); });
  }
}

TEST_CASE("damped springs go by the midpoint rule") {
  check_steps(method_of("midpoint"), [](const Spring& s, const Spring&) { return midpoint(s); });
}

TEST_CASE("damped springs go by BDF2 after a step of implicit Euler") {
  check_steps(method_of("bdf2"), [](const Spring& s, const Spring& last) { return bdf2(s, last); });
}

TEST_CASE("a damped value goes by the map's rule, bent by the speed across it") {
  Scene scene = damped_spring();
  const double across = 2, pulled = 3;  // m/s, m/s^2
  scene.initial.v(1, 1) = across;
  scene.initial.v(0, 1) = 0.5;
  RigidStep step{make_step_model(scene).rigid, scene.initial, 0.01};
  Vector acceleration = Vector::Zero(3);
  acceleration[0] = pulled;
  step.map = IntegratorMap{.d = 0.004,
                           .s = 0.006,
                           .shift = Vector::Zero(3),
                           .base = Vector::Zero(3),
                           .along = 0.003,
                           .bend = 2e-5,
                           .acceleration = acceleration};
  const Damping damping = damping_of(scene, step).at(0);
  const double share = 1 / (1 + retardation / 0.004), length = 1 + stretch;
  CHECK(std::abs(damping.share(0, 0) - share) <= by_hand);
  // The length's second derivative is a + v^2/r; differences over d miss (d v/r)^2 of that.
  const double exact = stretch + 0.003 * 0.5 + 2e-5 * (pulled + across * across / length);
  CHECK(std::abs(damping.offset[0] / (1 - share) - exact) <= 2e-5 * across * across * 1e-4);
}
