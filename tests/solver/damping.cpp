// Damping inside the constraints: closed forms of one oscillator, dense solutions of one tetrahedron, a
// swinging damped spring against a fine Runge-Kutta solution.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "dense.h"
#include "effects/effects.h"
#include "oscillator.h"
#include "scenes.h"
#include "step/integrators.h"

using namespace pbd;
using namespace pbd::test;

namespace {

using std::numbers::pi;

/// 1 kg between two walls, on two damped springs in line that make w rad/s together.
Scene between_walls(double w, double damping_s) {
  Scene scene;
  add_node(scene, Vec3(-1, 0, 0), infinity);
  add_node(scene, Vec3(0.1, 0, 0), 1);
  add_node(scene, Vec3(1, 0, 0), infinity);
  const double compliance = 2 / (w * w);
  scene.effects.emplace_back(Distance{.node = {{0, 1}, {1, 2}},
                                      .rest_length = {1, 1},
                                      .compliance = {compliance, compliance},
                                      .damping = {damping_s, damping_s}});
  return scene;
}

/// A bob of 1 kg on a damped spring of rest length 1 m.
constexpr double swing_stiffness = 100, swing_damping = 0.05;
Scene swing() {
  Scene scene;
  add_node(scene, Vec3::Zero(), infinity);
  add_node(scene, Vec3(1.2, 0, 0), 1, Vec3(0, 0, -1));
  scene.effects.emplace_back(Gravity{});
  scene.effects.emplace_back(Distance{
      .node = {{0, 1}}, .rest_length = {1}, .compliance = {1 / swing_stiffness}, .damping = {swing_damping}});
  return scene;
}

/// Its end after `duration` s by the classical Runge-Kutta rule, in the plane.
Eigen::Vector2d swung(double duration, int steps) {
  using Vec4 = Eigen::Vector4d;
  const auto rate = [](const Vec4& y) {
    const double length = y.head<2>().norm();
    const Eigen::Vector2d u = y.head<2>() / length;
    const double tension = swing_stiffness * (length - 1 + swing_damping * u.dot(y.tail<2>()));
    Vec4 dy;
    dy << y.tail<2>(), -tension * u - Eigen::Vector2d(0, gravity);
    return dy;
  };
  Vec4 y(1.2, 0, 0, -1);
  const double h = duration / steps;
  for (int k = 0; k < steps; ++k) {
    const Vec4 a = rate(y), b = rate(y + h / 2 * a), c = rate(y + h / 2 * b), d = rate(y + h * c);
    y += h / 6 * (a + 2 * b + 2 * c + d);
  }
  return y.head<2>();
}

}  // namespace

TEST_CASE("a damped oscillator's decrement is the discrete closed form, however many sweeps a solve takes") {
  const double w = 2 * pi, h = 0.01, damping = GENERATE(0.002, 0.05);
  const int sweeps = GENERATE(10, 1000);
  const std::string relaxation = GENERATE("gauss_seidel", "jacobi", "nesterov_jacobi", "direct");
  const Scene scene = between_walls(w, damping);
  Method method;
  method.relaxation = relaxation;
  method.max_sweeps = sweeps;
  method.tolerance = 1e-13;
  Workspace workspace(scene, method);
  State state = scene.initial;
  std::vector<double> q;
  for (int k = 0; k < 4; ++k) {
    CHECK(step(workspace, h, state).status == Status::ok);
    q.push_back(state.x(0, 1));
  }
  const auto found = measured(q);
  // v' = v - h w^2 ((1 + T/h) q' - T/h q), q' = q + h v': the determinant is 1/D and the trace 1 + (1 - h^2
  // w^2)/D with D = 1 + h w^2 (h + T).
  const double d = 1 + h * w * w * (h + damping);
  const double phi = std::acos((1 + (1 - h * h * w * w) / d) / 2 * std::sqrt(d));
  const double decrement = pi * std::log(d) / phi;
  INFO(relaxation << ", " << sweeps << " sweeps, T " << damping);
  CHECK(-2 * pi * std::log(found.growth) / found.phase == Approx(decrement).epsilon(1e-8));
}

TEST_CASE("as the step shrinks the decrement is that of the damping coefficient") {
  // k = 100 N/m, m = 1 kg, c = 1 N s/m: 0.314552702 a period.
  const double w = 10, damping = 0.01, h = 1e-5;
  const auto found = reference::oscillator_rules().front().step(h, w, damping);
  const double c = w * w * damping, zeta = c / (2 * w);
  const double exact = 2 * pi * zeta / std::sqrt(1 - zeta * zeta);
  CHECK(exact == Approx(0.314552702).epsilon(1e-8));
  // Implicit Euler adds its own decay, h w^2/2 per second, to first order.
  CHECK(-2 * pi * std::log(found.growth) / found.phase == Approx(exact + pi * h * w).epsilon(1e-4));
}

TEST_CASE("damping keeps every integrator's order where directions turn") {
  const Scene scene = swing();
  const double duration = 0.5;
  const Eigen::Vector2d exact = swung(duration, 20000);
  CHECK((exact - swung(duration, 10000)).norm() < 1e-12);
  for (const auto& rule : reference::oscillator_rules()) {
    const auto error = [&](int steps) {
      Method method = method_of(rule.integrator, 1e-12);
      method.alpha = rule.alpha;
      Workspace workspace(scene, method);
      State state = scene.initial;
      for (int k = 0; k < steps; ++k) step(workspace, duration / steps, state);
      return (Eigen::Vector2d(state.x(0, 1), state.x(2, 1)) - exact).norm();
    };
    INFO(rule.integrator << ", alpha " << rule.alpha);
    CHECK(std::log2(error(1000) / error(2000)) == Approx(rule.order).margin(0.06));
  }
}

TEST_CASE("plain's contraction is predicted of damped rows, too: d p/(m l) across a taut link") {
  const double h = 0.3;
  const Scene scene = swing();
  Method method = method_of("implicit_euler", 1e-10);
  method.outer = "proximal";  // of quasi_newton a bound is told
  State state = scene.initial;
  state.x(0, 1) = 4;
  Workspace workspace(scene, method);
  const Report report = step(workspace, h, state);
  CHECK(report.status == Status::ok);
  CHECK(report.contraction > 1);
  const double impulse = std::abs(workspace.impulses(1).at(0));
  CHECK(report.contraction == Approx(h * impulse / state.x.col(1).norm()).epsilon(0.01));
}

TEST_CASE("the error of a hard constraint decays with its retardation time") {
  const double time = 0.03, h = 0.01;
  Scene scene;
  add_node(scene, Vec3::Zero(), infinity);
  add_node(scene, Vec3(1.5, 0, 0), 1);
  scene.effects.emplace_back(
      Distance{.node = {{0, 1}}, .rest_length = {1}, .compliance = {0}, .damping = {time}});
  const Method method = method_of("implicit_euler");
  Workspace workspace(scene, method);
  State state = scene.initial;
  for (int k = 1; k <= 10; ++k) {
    CHECK(step(workspace, h, state).status == Status::ok);
    CHECK(state.x(0, 1) - 1 == Approx(0.5 * std::pow(time / (h + time), k)).epsilon(1e-10));
  }
}

TEST_CASE("damping between nodes takes no linear momentum, and none of a translation") {
  Scene scene = chain(6, 10, true);
  scene.effects.erase(scene.effects.begin());
  auto& links = std::get<Distance>(scene.effects[0]);
  for (double& each : links.compliance) each = 1e-2;
  links.damping.assign(links.node.size(), 0.005);
  scene.initial.v.colwise() = Vec3(1, -2, 3);
  const Vec3 before = momentum(scene, scene.initial);
  const bool shaken = GENERATE(false, true);
  if (shaken)
    for (int node = 0; node < scene.nodes(); ++node) scene.initial.v(2, node) += std::sin(2.0 * node);
  const Vec3 expected = momentum(scene, scene.initial);
  for (const auto& integrator : integrators()) {
    Method method;
    method.integrator = integrator.name;
    method.max_outer = 2;
    Workspace workspace(scene, method);
    State state = scene.initial;
    for (int k = 0; k < 200; ++k) step(workspace, 0.01, state);
    INFO(integrator.name);
    CHECK((momentum(scene, state) - expected).norm() < 1e-12 * before.norm());
    if (!shaken) CHECK((state.v.colwise() - Vec3(1, -2, 3)).norm() < 1e-12);
  }
}

TEST_CASE("damping takes no angular momentum, and nothing of bodies and nodes that turn as one") {
  constexpr double spin = 10, compliance = 2e-3, h = 1e-3;
  const bool of_node = GENERATE(false, true);
  // Each 0.5 m from the joint, which the centrifugal force of 1 kg opens: k e = w^2 (0.5 + e / 2).
  const double opened = 0.5 * spin * spin / (1 / compliance - spin * spin / 2);
  const auto turning = [&](double retardation) {
    Scene scene;
    for (const double side : {-1.0, 1.0}) {
      const Vec3 x(side * (0.5 + opened / 2), 0, 0), v(0, spin * x.x(), 0);
      if (of_node && side > 0)
        add_node(scene, x, 1, v);
      else
        add_body(scene, x, 1, Vec3::Constant(0.02), Eigen::Quaterniond::Identity(), v, Vec3(0, 0, spin));
    }
    scene.effects.emplace_back(Gyroscopic{});
    const std::vector<double> damping(retardation > 0 ? 1 : 0, retardation);
    if (of_node)
      scene.effects.emplace_back(Attachment{.body = {0},
                                            .node = {1},
                                            .point = {Vec3(1, 0, 0)},
                                            .compliance = {compliance},
                                            .damping = damping});
    else
      scene.effects.emplace_back(PointJoint{.body = {{0, 1}},
                                            .point = {{Vec3(0.5, 0, 0), Vec3(-0.5, 0, 0)}},
                                            .compliance = {compliance},
                                            .damping = damping});
    return scene;
  };
  const auto spun = [](const Scene& scene, const State& state) {
    Vec3 sum = Vec3::Zero();
    for (int node = 0; node < scene.nodes(); ++node)
      sum += scene.mass[static_cast<std::size_t>(node)] * state.x.col(node).cross(state.v.col(node));
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
      sum +=
          state.orientation[b] * scene.bodies[b].inertia.cwiseProduct(Vec3(state.spin.col(Eigen::Index(b))));
    return sum.z();
  };
  std::array<double, 2> left{}, apart{};
  for (const std::size_t damped : {0U, 1U}) {
    const Scene scene = turning(damped == 1 ? 0.02 : 0);
    Method method;
    method.relaxation = "direct";
    method.integrator = "newmark";
    method.tolerance = 1e-11;
    Workspace workspace(scene, method);
    State state = scene.initial;
    for (int k = 0; k < 500; ++k) REQUIRE(step(workspace, h, state).status == Status::ok);
    left[damped] = spun(scene, state) / spun(scene, scene.initial);
    apart[damped] = (state.x.col(1) - state.x.col(0)).norm();
  }
  // An impulse acts along the direction at the step's end, a turn of w h / 2 from the middle of its motion:
  // of its w^2 (1 + e) h / 2 that leaves the share w h / 2 across, and each step the share (w h)^2 / 2 of the
  // speed.
  const double drift = 500 * spin * spin * h * h / 2;
  CHECK(std::abs(left[0] - 1) <= drift);
  CHECK(std::abs(left[1] - left[0]) <= 0.1 * drift);  // a damper in the world's axes takes twice the drift
  // The opening is in proportion to the speed's square, so to twice the drift.
  for (const double each : apart) CHECK(std::abs(each - (1 + opened)) <= 2 * drift * opened * (1 + opened));
}
