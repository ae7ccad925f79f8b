// What steps hand on that were cut off before they were solved.
#include <catch2/catch.hpp>

#include "contact_runs.h"
#include "linear/linear_names.h"
#include "scenes/contacts.h"

using namespace pbd;
using namespace pbd::test;
using pbdcheck::column, pbdcheck::pile, pbdcheck::pyramid;

namespace {

/// J, of what moves: kinetic energy and weight above the origin.
double energy(const Scene& scene, const State& state) {
  double sum = 0;
  for (int node = 0; node < scene.nodes(); ++node)
    if (std::isfinite(scene.mass[node]))
      sum += scene.mass[node] * (state.v.col(node).squaredNorm() / 2 + gravity * state.x(2, node));
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Vec3 spin = state.spin.col(static_cast<Eigen::Index>(b));
    if (scene.bodies[b].inertia.allFinite()) sum += spin.dot(scene.bodies[b].inertia.cwiseProduct(spin)) / 2;
  }
  return sum;
}

Method cut_off(std::string_view relaxation, int outer_iterations) {
  Method method;
  method.relaxation = relaxation;
  method.max_outer = outer_iterations;
  method.max_sweeps = 20;
  return method;
}

std::vector<std::string_view> solvers_of_contact() {
  std::vector<std::string_view> all = general_solver_names();
  all.emplace_back("direct");
  return all;
}

/// A chain of bars that hangs from a fixed one, its first bar level; the last one is `ratio` times as heavy.
Scene hanging_bars(double ratio) {
  constexpr int count = 6;
  Scene scene;
  PointJoint joints;
  const int wall = add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
  for (int k = 0; k < count; ++k) {
    const double mass = k + 1 < count ? 1 : ratio;
    const int bar = add_body(scene, Vec3(0.2 * k + 0.1, 0, 0), mass, mass * Vec3(1e-4, 4e-3, 4e-3));
    joints.body.push_back({k == 0 ? wall : bar - 1, bar});
    joints.point.push_back({Vec3(k == 0 ? 0 : 0.1, 0, 0), Vec3(-0.1, 0, 0)});
    joints.compliance.push_back(0);
  }
  scene.effects = {Gravity{}, Gyroscopic{}, joints};
  return scene;
}

}  // namespace

// Newmark's rebound ends in what it bounces off, and continuous contact holds it back.
TEST_CASE("the step after a missed one that was held back knows of no force") {
  const double restitution = GENERATE(0.01, 0.5);
  pbdcheck::BodyScene build(ContactLaw{.friction = 0, .restitution = restitution});
  build.fixed(Box{Vec3(2, 2, 0.2)}, {.position = {0, 0, -0.1}});
  build.ball(0.05, 2, {.position = {0, 0, 0.1525}, .velocity = {0, 0, -5}});
  build.contact().continuous = true;
  Method method;
  method.integrator = "newmark";
  method.alpha = 0.55;
  const Scene scene = build.finish();
  Workspace workspace(scene, method);
  State state = scene.initial;
  constexpr double h = 0.01;
  Status last = Status::ok;
  for (int k = 0; k < 5 && last == Status::ok; ++k) last = step(workspace, h, state).status;
  REQUIRE(last == Status::not_converged);
  const State begun = state;
  REQUIRE(begun.v(2, 1) > 0);
  REQUIRE(step(workspace, h, state).status == Status::ok);
  CHECK((state.v - begun.v).col(1).z() == Approx(-gravity * h).epsilon(1e-12));
}

TEST_CASE("steps that are cut off gain no energy") {
  const auto [name, scene] = GENERATE(table<std::string, Scene>({{"column", column(5)},
                                                                 {"heavy above light", column(5, 10)},
                                                                 {"pyramid", pyramid(3)},
                                                                 {"pile", pile()},
                                                                 {"bars", hanging_bars(1)},
                                                                 {"heavy bar", hanging_bars(100)}}));
  const auto relaxation = GENERATE(from_range(solvers_of_contact()));
  constexpr int steps = 20;
  const double height = scene.initial.x.cwiseAbs().maxCoeff();  // m
  for (const int outer_iterations : {1, 3, 10, 30}) {
    const Method method = cut_off(relaxation, outer_iterations);
    Workspace workspace(scene, method);
    State state = scene.initial;
    const double start = energy(scene, state);
    double gain = -infinity;
    for (int k = 0; k < steps; ++k) {
      step(workspace, 0.01, state);
      gain = std::max(gain, energy(scene, state) - start);
    }
    INFO(name << ", " << relaxation << ", " << outer_iterations << " iterations");
    CHECK(gain <= steps * method.tolerance * weight(scene) * height);
  }
}

TEST_CASE("steps that are cut off keep the momentum of what nothing holds") {
  constexpr double side = 0.2, mass = 1;  // m, kg
  constexpr int cubes = 4;
  Scene scene;
  Contact contact;
  for (int k = 0; k < cubes; ++k) {
    const Vec3 inertia = Vec3::Constant(mass * side * side / 6);
    const Vec3 velocity(k < 2 ? 3 : -1, 0.2 * k, 0);
    const int body = add_body(scene, Vec3(1.01 * side * k, 0.3 * side * (k % 2), 0), mass, inertia,
                              Eigen::Quaterniond::Identity(), velocity, Vec3(0, 0, k));
    contact.collider.push_back({Box{Vec3::Constant(side)}, body});
  }
  scene.effects = {Gyroscopic{}, contact};
  const Vec3 before = mass * scene.initial.v.rowwise().sum();
  const auto relaxation = GENERATE(from_range(solvers_of_contact()));
  Workspace workspace(scene, cut_off(relaxation, 1));
  State state = scene.initial;
  int missed = 0;
  for (int k = 0; k < 10; ++k) missed += step(workspace, 0.01, state).status != Status::ok;
  INFO(relaxation);
  CHECK(missed > 0);
  const double speeds = mass * scene.initial.v.colwise().norm().sum();
  CHECK((mass * state.v.rowwise().sum() - before).norm() < 1e-14 * 10 * cubes * speeds);  // rounding
}

TEST_CASE("a pile settles over steps that are cut off: each goes on where the last one was") {
  constexpr double radius = 0.1;  // m
  constexpr int layers = 5, wide = 10, steps = 20, sweeps = 20;
  pbdcheck::BodyScene build({.friction = 0.5});
  build.ground();
  for (int i = 0; i < wide; ++i)
    for (int j = 0; j < wide; ++j)
      for (int k = 0; k < layers; ++k) build.ball(radius, 4, {radius * Vec3(2 * i, 2 * j, 2 * k + 1)});
  const Scene scene = build.finish();
  Method method;
  method.relaxation = "gauss_seidel";
  method.tolerance = 0;
  method.max_outer = 2;
  method.max_sweeps = sweeps / 2;
  Workspace workspace(scene, method);
  State state = scene.initial;
  double first = 0, last = 0;
  for (int k = 0; k < steps; ++k) {
    last = step(workspace, 1.0 / 240, state).residual();
    if (k == 0) first = last;
  }
  // The sweeps of a step multiply the error of a column by q; the tenth of the overlap that the next step
  // parts (effects/contact.h) adds to it what decays by 0.9 a step.
  const double q = std::pow(std::cos(std::acos(-1.0) / (2 * layers + 1)), 2 * sweeps);
  const double left = std::pow(q, steps) + 0.1 * std::pow(0.9, steps) * q / (1 - q / 0.9);
  INFO("first " << first << ", last " << last);
  CHECK(last < left * first);
}
