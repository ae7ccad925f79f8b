// Integrators against their closed forms on a spring, and against the pendulum's quarter period.
#include "step/integrators.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "oscillator.h"
#include "scenes.h"

using namespace pbd;
using namespace pbd::test;

namespace {

using std::numbers::pi;

/// The scene after steps of the given lengths, which are to meet the tolerance.
State after(const Scene& scene, const Method& method, const std::vector<double>& lengths) {
  Workspace workspace(scene, method);
  State state = scene.initial;
  int missed = 0;
  for (const double h : lengths) missed += step(workspace, h, state).status != Status::ok;
  CHECK(missed == 0);
  return state;
}

/// Steps that make up `duration` (s): all the same, or long and short ones by turns.
std::vector<double> equal_steps(double duration, int count) {
  return std::vector<double>(static_cast<std::size_t>(count), duration / count);
}
std::vector<double> mixed_steps(double duration, int count) {
  auto lengths = equal_steps(duration, count);
  for (std::size_t k = 0; k < lengths.size(); ++k) lengths[k] *= k % 2 == 0 ? 1.3 : 0.7;
  return lengths;
}

double energy_of_spring(const State& state, double w) {
  return (state.v.col(1).squaredNorm() + std::pow(w * (state.x(0, 1) - 1), 2)) / 2;
}

}  // namespace

TEST_CASE("a step multiplies and turns an oscillation as the integrator's matrix does") {
  const double w = 2 * pi, h = GENERATE(0.1, 0.01), damping = GENERATE(0.0, 0.02);
  for (const auto& rule : reference::oscillator_rules()) {
    Method method = method_of(rule.integrator);
    method.alpha = rule.alpha;
    const auto expected = rule.step(h, w, damping);
    const auto found = measured(spring(w, 0.5, damping), method, h, rule.settled);
    INFO(rule.integrator << ", alpha " << rule.alpha << ", h " << h << ", damping " << damping);
    CHECK(found.growth == Approx(expected.growth).epsilon(1e-10));
    CHECK(found.phase == Approx(expected.phase).epsilon(1e-10));
  }
}

TEST_CASE("Newmark's family follows its own recurrence, whose force is that of the step's end") {
  const double w = 2 * pi, h = 0.05, beta = 0.3, gamma = 0.6, damping = GENERATE(0.0, 0.02);
  Method method = method_of("newmark");
  method.beta = beta;
  method.gamma = gamma;
  const Scene scene = spring(w, 0.5, damping);
  Workspace workspace(scene, method);
  State state = scene.initial;
  double q = 0.5, v = 0, a = -w * w * q;
  for (int k = 0; k < 100; ++k) {
    step(workspace, h, state);
    q += h * v + h * h * (0.5 - beta) * a;
    v += h * (1 - gamma) * a;
    a = -w * w * (q + damping * v) / (1 + w * w * (beta * h * h + damping * gamma * h));
    q += h * h * beta * a;
    v += h * gamma * a;
    CHECK(state.x(0, 1) - 1 == Approx(q).margin(1e-12));
    CHECK(state.v(0, 1) == Approx(v).margin(1e-11));
  }
}

TEST_CASE("the trapezoidal and the midpoint rule keep a spring's energy, implicit Euler loses its share") {
  const double w = 4 * pi, h = 1.0 / 60;
  const int steps = 600;
  const Scene scene = spring(w, 0.1);
  const double before = energy_of_spring(scene.initial, w);
  for (const std::string integrator : {"newmark", "midpoint"}) {
    Method method = method_of(integrator);
    method.alpha = 0.5;
    Workspace workspace(scene, method);
    State state = scene.initial;
    double largest = 0;
    for (int k = 0; k < steps; ++k) {
      step(workspace, h, state);
      largest = std::max(largest, std::abs(energy_of_spring(state, w) / before - 1));
    }
    INFO(integrator);
    CHECK(largest < 1e-10);
  }
  const State state = after(scene, method_of("implicit_euler"), equal_steps(steps * h, steps));
  CHECK(energy_of_spring(state, w) / before == Approx(std::pow(1 + h * h * w * w, -steps)).epsilon(1e-8));
}

TEST_CASE("every integrator has its declared order on a spring, with equal steps and with mixed ones") {
  const double w = 2 * pi, duration = 0.7;
  const Scene scene = spring(w, 0.1);
  const double exact = 1 + 0.1 * std::cos(w * duration);
  const auto order = [&](const Method& method, auto steps) {
    const auto error = [&](int count) {
      return std::abs(after(scene, method, steps(duration, count)).x(0, 1) - exact);
    };
    return std::log2(error(2000) / error(4000));
  };
  for (const auto& integrator : integrators()) {
    INFO(integrator.name);
    CHECK(order(method_of(integrator.name), equal_steps) == Approx(integrator.order).margin(0.05));
    CHECK(order(method_of(integrator.name), mixed_steps) == Approx(integrator.order).margin(0.05));
  }
  Method trapezoid = method_of("newmark");
  trapezoid.alpha = 0.5;
  CHECK(order(trapezoid, equal_steps) == Approx(2).margin(0.05));
}

TEST_CASE("generalised alpha is exact for a force that grows evenly, also where steps grow or shrink") {
  // So slow a spring that its force is even in time but for (w h)^2; the speed is v0 cos(w t). A step's
  // share of the start, where the kept acceleration is another, dies out.
  const double w = 0.01, h = 0.01, factor = GENERATE(0.3, 2.0);
  Scene scene = spring(w, 0);
  scene.initial.v(0, 1) = 1;
  const Method method = method_of("generalised_alpha");
  Workspace workspace(scene, method);
  State state = scene.initial;
  for (int k = 0; k < 100; ++k) REQUIRE(step(workspace, h, state).status == Status::ok);
  for (int k = 0; k < 3; ++k) {
    const double t = state.time, before = state.v(0, 1);
    REQUIRE(step(workspace, factor * h, state).status == Status::ok);
    CHECK(state.v(0, 1) - before == Approx(std::cos(w * state.time) - std::cos(w * t)).epsilon(1e-5));
  }
}

TEST_CASE("every integrator has its declared order on a pendulum") {
  // Released horizontally, at the bottom after a quarter of the period 4 K(sin 45 deg) sqrt(l/g).
  const Scene scene = pbdcheck::pendulum(pi / 2, 0);
  const double quarter = std::comp_ellint_1(std::sin(pi / 4)) / std::sqrt(gravity);
  for (const auto& integrator : integrators()) {
    const Method method = method_of(integrator.name, 1e-12);
    const auto error = [&](int count) {
      return std::abs(after(scene, method, equal_steps(quarter, count)).x(0, 1));
    };
    INFO(integrator.name);
    CHECK(std::log2(error(800) / error(1600)) == Approx(integrator.order).margin(0.05));
  }
}

TEST_CASE("whoever changes the state between two steps starts the integrator anew") {
  const Scene scene = chain(4);
  State other = scene.initial;
  other.v.row(2).setConstant(-0.5);
  other.v.col(0).setZero();
  for (const auto& integrator : integrators()) {
    Method method = method_of(integrator.name, 1e-10);
    method.warm_start = false;
    Workspace used(scene, method), fresh(scene, method);
    State state = scene.initial;
    for (int k = 0; k < 3; ++k) step(used, 0.01, state);
    State after_used = other, after_fresh = other;
    INFO(integrator.name);
    for (int k = 0; k < 3; ++k) {
      step(used, 0.01, after_used);
      step(fresh, 0.01, after_fresh);
      CHECK(after_used.x == after_fresh.x);
      CHECK(after_used.v == after_fresh.v);
    }
  }
}

TEST_CASE("linear momentum of pairwise constraints is conserved by every integrator, converged or not") {
  const std::string relaxation =
      GENERATE("gauss_seidel", "jacobi", "nesterov_jacobi", "conjugate_gradients", "direct");
  const double compliance = GENERATE(0.0, 1e-2);
  const int max_outer = GENERATE(2, 100);
  Scene scene = chain(6, 10, true);
  scene.effects.erase(scene.effects.begin());
  for (double& each : std::get<Distance>(scene.effects[0]).compliance) each = compliance;
  for (int node = 0; node < scene.nodes(); ++node)
    scene.initial.v.col(node) = Vec3(std::sin(node), std::cos(2.0 * node), std::sin(3.0 * node)) / 10;
  const Vec3 before = momentum(scene, scene.initial);
  for (const auto& integrator : integrators()) {
    if (integrator.name == "midpoint" && compliance == 0) continue;  // unstable with hard constraints
    Method method;
    method.integrator = integrator.name;
    method.relaxation = relaxation;
    method.max_sweeps = 50;
    method.max_outer = max_outer;
    Workspace workspace(scene, method);
    State state = scene.initial;
    int missed = 0;
    for (int k = 0; k < 1000; ++k) missed += step(workspace, 0.01, state).status != Status::ok;
    INFO(integrator.name << ' ' << relaxation << ", compliance " << compliance << ", missed " << missed);
    const bool explicit_alone = integrator.explicit_forces && compliance > 0;
    CHECK((missed > 0) == (max_outer == 2 && !explicit_alone));
    CHECK((momentum(scene, state) - before).norm() < 1e-12 * before.norm());
  }
}

TEST_CASE("linear momentum of a chain is conserved where proximal steps are left unconverged") {
  Scene scene = chain(20, 10, true);
  scene.effects.erase(scene.effects.begin());
  for (int node = 0; node < scene.nodes(); ++node)
    scene.initial.v.col(node) = Vec3(std::sin(node), std::cos(2.0 * node), std::sin(3.0 * node));
  const std::string relaxation =
      GENERATE("gauss_seidel", "jacobi", "nesterov_jacobi", "conjugate_gradients", "direct");
  Method method;
  method.relaxation = relaxation;
  method.max_outer = 3;
  State state = scene.initial;
  Workspace workspace(scene, method);
  const Vec3 before = momentum(scene, state);
  for (int k = 0; k < 100; ++k) step(workspace, 0.01, state);
  INFO(relaxation);
  CHECK((momentum(scene, state) - before).norm() < 1e-12 * before.norm());
}

TEST_CASE("symplectic_euler has rows for hard constraints alone") {
  Scene scene = chain(4);
  auto& links = std::get<Distance>(scene.effects[1]);
  links.compliance[1] = links.compliance[2] = 1e-2;
  const Method method = method_of("symplectic_euler", 1e-12);
  Workspace workspace(scene, method);
  State state = scene.initial;
  // One step from rest: forces of the springs, none yet, gravity, and the hard links along x.
  CHECK(step(workspace, 0.01, state).status == Status::ok);
  CHECK(workspace.costs().at(0).rows == 2);
  const auto impulses = workspace.impulses(1);
  CHECK(std::count_if(impulses.begin(), impulses.end(), [](double p) { return std::isfinite(p); }) == 2);
  CHECK(state.x(2, 4) == Approx(-gravity * 1e-4).epsilon(1e-12));
  for (double& each : links.compliance) each = 1e-2;
  CHECK(Workspace(scene, method).costs().empty());
}

TEST_CASE("parameters out of their range are refused") {
  const Scene scene = spring(1, 0);
  Method method;
  method.alpha = 0.4;
  CHECK_THROWS_WITH(Workspace(scene, method), Catch::Contains("alpha: got 0.4; allowed: 0.5 to 1"));
  method = {};
  method.rho = 1.5;
  CHECK_THROWS_WITH(Workspace(scene, method), Catch::Contains("rho: got 1.5; allowed: 0 to 1"));
  method = {};
  method.beta = 0.25;
  CHECK_THROWS_WITH(Workspace(scene, method), Catch::Contains("beta: got one of beta and gamma"));
  method.gamma = 0.4;
  CHECK_THROWS_WITH(Workspace(scene, method), Catch::Contains("gamma: got 0.4"));
}
