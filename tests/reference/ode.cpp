// Trajectories of compliant scenes against formulas and other equations of the same motion; failures.
#include "ode.h"

#include <Eigen/Dense>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "assembly.h"
#include "closed_form.h"
#include "error.h"
#include "mesh.h"

using namespace pbd;
using namespace pbd::reference;

namespace {

constexpr double g = 9.81, tolerance = 1e-13;

std::vector<double> times_to(double end, int count) {
  std::vector<double> times;
  for (int i = 0; i <= count; ++i) times.push_back(end * i / count);
  return times;
}

/// Sum of the errors the steps may make in a component of size `largest`.
double summed_error(long evaluations, double largest) {
  return static_cast<double>(evaluations) / 13 * 1.1 * tolerance * (1 + largest);
}

Scene spring_pendulum(double compliance, double angle) {
  Scene scene;
  add_node(scene, Vec3::Zero(), infinity);
  add_node(scene, Vec3(std::sin(angle), 0, -std::cos(angle)), 1);
  scene.effects = {Gravity{}, Distance{{{0, 1}}, {1}, {compliance}}};
  return scene;
}

Scene clamped_bar(Strain strain) {
  Scene scene;
  add_solid(scene, kuhn_grid({4, 1, 1}, Vec3(1, 0.25, 0.25)), 1000, {1e5, 0.3}, strain);
  for (int i = 0; i < scene.nodes(); ++i)
    if (scene.initial.x(0, i) == 0) scene.mass[i] = infinity;
  scene.effects.emplace_back(Gravity{});
  return scene;
}

/// Triangles, hinges and links of a sheet held at two corners, one of them by an anchor.
Scene sheet() {
  const TriangleMesh mesh = grid_sheet({3, 3}, {1, 1});
  Scene scene;
  add_sheet_nodes(scene, mesh, 0.2);
  scene.mass[0] = infinity;
  scene.effects = {Gravity{},
                   sheet_strain(mesh, 0, {1e4, 0.3}, 1e-3),
                   sheet_bending(mesh, 0, 10),
                   sheet_links(mesh, 0, 1e-2),
                   Anchor{{3}, {scene.initial.x.col(3)}, {1e-3}},
                   ExternalForce{{15}, {Vec3(0.1, 0.2, 0)}}};
  return scene;
}

Trajectory solved_ode(const Scene& scene, const std::vector<double>& times) {
  Trajectory trajectory = ode(scene, times, {tolerance});
  INFO(trajectory.reason);
  REQUIRE(trajectory.outcome == Outcome::ok);
  REQUIRE(trajectory.samples.size() == times.size());
  return trajectory;
}

}  // namespace

TEST_CASE("the ODE solver follows Kepler's equation through ten orbits") {
  const double e = 0.6;
  const auto slope = [](double, const Vector& y, Vector& out) {
    out << y.tail<2>(), -y.head<2>() / std::pow(y.head<2>().norm(), 3);
  };
  const std::vector<double> times = times_to(20 * std::numbers::pi, 37);
  const PlanarState start = kepler_orbit(1, 1, e, 0);
  const OdeSolution found = solve_ode(slope, Eigen::Vector4d(start.x, start.y, start.vx, start.vy), times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const PlanarState exact = kepler_orbit(1, 1, e, times[i]);
    // An error d of the state changes the energy by (v + 1/r^2) d, the frequency by 3 times that, and the
    // place along the orbit by v t times that again; all largest at the pericentre.
    const double near = 1 - e, speed = start.vy;
    const double growth = 1 + 3 * (speed + 1 / (near * near)) * speed * times[i];
    const double bound = summed_error(found.evaluations, speed) * growth;
    CHECK(std::hypot(found.states[i](0) - exact.x, found.states[i](1) - exact.y) <= bound);
  }
}

TEST_CASE("a column of springs let go vibrates in its modes") {
  const int n = 10;
  const double stiffness = 1e3;
  Scene scene;
  Distance springs;
  add_node(scene, Vec3::Zero(), infinity);
  for (int i = 1; i <= n; ++i) {
    add_node(scene, Vec3(0, 0, -i), 1);
    springs.node.push_back({i - 1, i}), springs.rest_length.push_back(1);
    springs.compliance.push_back(1 / stiffness);
  }
  scene.effects = {Gravity{}, springs};
  const std::vector<double> times = times_to(5, 23);
  const Trajectory found = solved_ode(scene, times);
  // Mode j is sin((2j-1) pi i/(2n+1)); released from the unstretched state, each moves by (1 - cos w t) of
  // its part of the static stretch g/w^2.
  for (std::size_t s = 0; s < times.size(); ++s)
    for (int i = 1; i <= n; ++i) {
      double fall = 0;
      for (int j = 1; j <= n; ++j) {
        const double phase = (2 * j - 1) * std::numbers::pi / (2 * n + 1);
        const double w = 2 * std::sqrt(stiffness) * std::sin(phase / 2);
        double share = 0;
        for (int k = 1; k <= n; ++k) share += std::sin(phase * k) * 4 / (2 * n + 1);
        fall += share * std::sin(phase * i) * g / (w * w) * (1 - std::cos(w * times[s]));
      }
      // An error of the rate moves the slowest mode by 1/w of it; errors of the modes do not grow.
      const double slowest = 2 * std::numbers::pi * spring_chain_frequency(n, stiffness, 1);
      const double bound = std::sqrt(n) * summed_error(found.evaluations, n + 1) * (1 + 1 / slowest);
      CHECK(std::abs(found.samples[s].x(2, i) + i + fall) <= bound);
      CHECK(found.samples[s].x.topRows<2>().isZero(0));
    }
}

TEST_CASE("a node on a compliant anchor swings about its rest along every axis") {
  Scene scene;
  add_node(scene, Vec3(0.1, 0.2, 0.3), 2, Vec3(1, -2, 0.5));
  const Vec3 target(-0.1, 0.4, 0.2), acceleration(1, -2, 3), force(4, 5, -6);
  scene.effects = {Gravity{acceleration}, ExternalForce{{0}, {force}}, Anchor{{0}, {target}, {1e-2}}};
  scene.initial.time = 7;
  const double w = std::sqrt(50.0);
  const std::vector<double> times = times_to(3, 7);
  const Trajectory found = solved_ode(scene, times);
  const Vec3 rest = target + (acceleration + force / 2) / (w * w);
  for (std::size_t s = 0; s < times.size(); ++s) {
    const double t = times[s];
    const Vec3 x = rest + (scene.initial.x.col(0) - rest) * std::cos(w * t) +
                   scene.initial.v.col(0) / w * std::sin(w * t);
    CHECK((found.samples[s].x.col(0) - x).norm() <= summed_error(found.evaluations, 3) * (1 + 1 / w) * 2);
    CHECK(found.samples[s].time == 7 + t);
  }
}

TEST_CASE("a spring pendulum moves as its equations in polar coordinates say") {
  const double compliance = 1e-2, angle = 0.8;
  const auto slope = [&](double, const Vector& y, Vector& out) {
    const double r = y(0), q = y(1), radial = y(2), rate = y(3);
    out << radial, rate, r * rate * rate - (r - 1) / compliance + g * std::cos(q),
        -(2 * radial * rate + g * std::sin(q)) / r;
  };
  const std::vector<double> times = times_to(5, 13);
  const Trajectory found = solved_ode(spring_pendulum(compliance, angle), times);
  const OdeSolution polar = solve_ode(slope, Eigen::Vector4d(1, angle, 0, 0), times);
  for (std::size_t s = 0; s < times.size(); ++s) {
    const Vector& y = polar.states[s];
    const Vec3 x = y(0) * Vec3(std::sin(y(1)), 0, -std::cos(y(1)));
    const Vec3 v = y(2) * x / y(0) + y(0) * y(3) * Vec3(std::cos(y(1)), 0, std::sin(y(1)));
    // Both are regular: errors grow at most linearly, with the spring's frequency.
    const double growth = 1 + times[s] / std::sqrt(compliance);
    const double bound = summed_error(found.evaluations + polar.evaluations, 5) * growth;
    CHECK((found.samples[s].x.col(1) - x).norm() <= bound);
    CHECK((found.samples[s].v.col(1) - v).norm() <= bound / std::sqrt(compliance));
  }
}

TEST_CASE("energy is conserved with every effect") {
  const std::vector<double> times = times_to(0.2, 20);
  for (const Scene& scene : {clamped_bar(Strain::green), clamped_bar(Strain::corotational),
                             clamped_bar(Strain::linear), sheet(), spring_pendulum(1e-4, 1)}) {
    const Trajectory found = solved_ode(scene, times);
    const Model model = make_model(scene);
    // dE = (dU/dx - f) dx + M v dv for errors dx, dv of each step; 2 for motion between the samples.
    double sensitivity = 0, kinetic = 0;
    for (const State& state : found.samples) {
      const Vector momentum = model.mass.cwiseProduct(gather(model, state.v));
      sensitivity = std::max(
          sensitivity, (energy_gradient(model, state.x) - model.force).lpNorm<1>() + momentum.lpNorm<1>());
      kinetic = std::max(kinetic, momentum.dot(gather(model, state.v)) / 2);
    }
    REQUIRE(kinetic > 0);
    REQUIRE(found.energy_drift);
    const double bound = 2 * summed_error(found.evaluations, 2) * sensitivity / kinetic;
    CHECK(*found.energy_drift <= bound);
    CHECK(bound < 1e-7);
  }
}

TEST_CASE("a scene whose supports move steadily moves with them") {
  const Vec3 velocity(0.3, -0.7, 0.2);
  const std::vector<double> times = times_to(1, 5);
  for (const Scene& at_rest : {spring_pendulum(1e-2, 1), clamped_bar(Strain::green)}) {
    Scene carried = at_rest;
    carried.initial.v.colwise() += velocity;
    const Trajectory a = solved_ode(at_rest, times), b = solved_ode(carried, times);
    CHECK(a.energy_drift);
    CHECK_FALSE(b.energy_drift);
    for (std::size_t s = 0; s < times.size(); ++s) {
      const Points moved = a.samples[s].x.colwise() + times[s] * velocity;
      const double bound = a.position_error[s] + b.position_error[s] + 1e-15;
      CHECK((moved - b.samples[s].x).colwise().norm().maxCoeff() <= bound);
      CHECK(((b.samples[s].v - a.samples[s].v).colwise() - velocity).colwise().norm().maxCoeff() <=
            a.velocity_error[s] + b.velocity_error[s] + 1e-15);
    }
  }
}

TEST_CASE("the error told bounds the error made, at every tolerance") {
  Scene scene = spring_pendulum(0, std::numbers::pi / 2);
  const std::vector<double> times = times_to(5, 11);
  for (const double asked : {1e-6, 1e-8, 1e-10, 1e-12, 1e-13}) {
    const Trajectory found = ode(scene, times, {asked});
    REQUIRE(found.outcome == Outcome::ok);
    for (std::size_t s = 1; s < times.size(); ++s) {
      const Angle exact = pendulum_motion(1, g, std::numbers::pi / 2, times[s]);
      const Vec3 x(std::sin(exact.angle), 0, -std::cos(exact.angle));
      const Vec3 v = exact.rate * Vec3(std::cos(exact.angle), 0, std::sin(exact.angle));
      INFO(asked << " at " << times[s]);
      CHECK((found.samples[s].x.col(1) - x).norm() <= found.position_error[s]);
      CHECK((found.samples[s].v.col(1) - v).norm() <= found.velocity_error[s]);
    }
  }
}

TEST_CASE("what cannot be integrated has a reason and no samples") {
  const Trajectory stopped = ode(clamped_bar(Strain::linear), {1}, {1e-13, 1000});
  CHECK(stopped.outcome == Outcome::not_converged);
  CHECK_THAT(stopped.reason, Catch::Contains("1000 evaluations"));
  CHECK(stopped.samples.empty());
  // y' = y^2 from 1 is 1/(1 - t).
  const auto blow_up = [](double, const Vector& y, Vector& out) { out << y(0) * y(0); };
  CHECK(solve_ode(blow_up, Vector::Ones(1), {0.5}).states[0](0) == Approx(2).epsilon(1e-11));
  CHECK_THROWS_AS(solve_ode(blow_up, Vector::Ones(1), {0.5, 1.1}), OdeFailure);
  const auto undefined = [](double t, const Vector&, Vector& out) { out << std::sqrt(1 - t); };
  CHECK_THROWS_AS(solve_ode(undefined, Vector::Ones(1), {2}), OdeFailure);
  struct Stopped {};
  CHECK_THROWS_AS(solve_ode(blow_up, Vector::Ones(1), {0.5}, {.poll = [] { throw Stopped(); }}), Stopped);
  // A short pulse that lifts y from 0 to 1, undefined above 1.2: only trial steps, too long ones, get there.
  const auto pulse = [](double t, const Vector& y, Vector& out) {
    out << (y(0) < 1.2 ? 50 / std::pow(std::cosh(100 * (t - 1)), 2) : std::nan(""));
  };
  CHECK(solve_ode(pulse, Vector::Zero(1), {2}).states[0](0) == Approx(1).epsilon(1e-10));
  for (const std::vector<double>& times : {std::vector{1.0, 0.5}, {-1.0}, {std::nan("")}})
    CHECK_THROWS_AS(solve_ode(blow_up, Vector::Ones(1), times), std::invalid_argument);
}
