// Integrators that carry on earlier steps, in contact: nothing of an impact goes on, what rests rests, and
// apart from impacts their order stays.
#include "contact_runs.h"
#include "scenes/contacts.h"

using namespace pbd;
using namespace pbd::test;
using pbdcheck::BodyScene;

namespace {

struct Rule {
  std::string integrator;
  double rho = 0.8;
};
const std::vector<Rule> of_order_two{{"bdf2"}, {"generalised_alpha"}, {"generalised_alpha", 0}};
const std::vector<Rule> rules{{"newmark"}, {"bdf2"}, {"generalised_alpha"}, {"generalised_alpha", 0}};

Method method_of(const Rule& rule) {
  Method method = contact_method("direct");
  method.integrator = rule.integrator;
  method.rho = rule.rho;
  return method;
}

Scene falling_ball(double restitution, double drop = 0.3) {
  BodyScene build({.friction = 0.5, .restitution = restitution});
  build.ground();
  build.ball(0.1, 2, {Vec3(0, 0, 0.1 + drop)});
  return build.finish();
}

/// A mass of 1 kg on a spring of 4 N/m that leaves its place at 3 m/s for a ground 1 m below.
Scene bouncing_spring() {
  BodyScene build({.friction = 0, .restitution = 0.8}, 0);
  build.fixed(HalfSpace{}, {Vec3(0, 0, -1)});
  Scene scene = build.finish();
  const int node = add_node(scene, Vec3::Zero(), 1, Vec3(0, 0, -3));
  scene.effects.emplace_back(Anchor{.node = {node}, .target = {Vec3::Zero()}, .compliance = {0.25}});
  for (Effect& effect : scene.effects)
    if (auto* contact = std::get_if<Contact>(&effect)) {
      contact->node = {node};
      contact->radius = {0};
      contact->node_material = {0};
    }
  return scene;
}

/// m, how far the spring is from its oscillation 1 s after its bounce, told from where that leaves it.
double error_after_bounce(const Rule& rule, double h) {
  const Scene scene = bouncing_spring();
  Workspace workspace(scene, method_of(rule));
  State state = scene.initial;
  while (!(state.v(2, 1) > 0)) REQUIRE(step(workspace, h, state).status == Status::ok);
  const double w = 2, x = state.x(2, 1), v = state.v(2, 1);
  for (int k = 0; k < std::lround(1 / h); ++k) REQUIRE(step(workspace, h, state).status == Status::ok);
  return std::abs(state.x(2, 1) - x * std::cos(w) - v / w * std::sin(w));
}

}  // namespace

TEST_CASE("a ball falls, is stopped and rests under integrators that carry on earlier steps") {
  for (const Rule& rule : rules)
    for (const double drop : {0.3, 0.31, 0.32, 0.33}) {  // it lands late in a step, or early
      constexpr double h = 0.01;
      const Scene scene = falling_ball(0, drop);
      INFO(rule.integrator << " " << rule.rho << " from " << drop);
      Workspace workspace(scene, method_of(rule));
      State state = scene.initial;
      double most = 0;  // J/kg
      for (int k = 0; k < std::lround(1 / h); ++k) {
        REQUIRE(step(workspace, h, state).status == Status::ok);
        CHECK(state.x(2, 1) >= 0.1 - 1e-10);
        CHECK(state.v(2, 1) <= 1e-9);
        most = std::max(most, state.v.col(1).squaredNorm() / 2 + gravity * (state.x(2, 1) - 0.1 - drop));
      }
      CHECK(most <= gravity * gravity * h * h / 8);  // what the first step, of implicit Euler, may be off
      CHECK(state.v.cwiseAbs().maxCoeff() <= 1e-9);
      CHECK(std::abs(state.x(2, 1) - 0.1) <= 1e-10);
      CHECK(std::abs(ground_force(workspace).z() / weight(scene) - 1) <= 1e-9);
    }
}

TEST_CASE(
    "a ball leaves the ground at its share of the speed under integrators that carry on earlier steps") {
  constexpr double e = 0.5, h = 0.001;
  const Scene scene = falling_ball(e);
  for (const Rule& rule : rules) {
    INFO(rule.integrator << " " << rule.rho);
    Workspace workspace(scene, method_of(rule));
    State state = scene.initial;
    int bounces = 0;
    double last = std::sqrt(2 * gravity * 0.3);  // m/s, of the ball as it meets the ground
    for (int k = 0; k < 700; ++k) {
      const double before = state.v(2, 1);
      REQUIRE(step(workspace, h, state).status == Status::ok);
      if (!(before < 0 && state.v(2, 1) > 0)) continue;
      ++bounces;
      CHECK(std::abs(state.v(2, 1) + e * before) <= 1e-12);
      CHECK(std::abs(state.v(2, 1) - e * last) <= 2 * gravity * h);
      last = state.v(2, 1);
    }
    CHECK(bounces >= 2);
  }
}

TEST_CASE("after a bounce an oscillation is of second order again") {
  for (const Rule& rule : of_order_two) {
    const double coarse = error_after_bounce(rule, 0.01), fine = error_after_bounce(rule, 0.005);
    INFO(rule.integrator << " " << rule.rho << ": " << coarse << ", " << fine);
    CHECK(std::log2(coarse / fine) == Approx(2).margin(0.15));
  }
}

TEST_CASE("a box slides v^2/(2 mu g), to second order of the step") {
  constexpr double mu = 0.4, speed = 2, h = 0.01;
  const Scene scene = pbdcheck::sliding_box(0, mu, speed);
  for (const Rule& rule : of_order_two) {
    const State end = run(scene, method_of(rule), h, 80);
    INFO(rule.integrator << " " << rule.rho << " " << end.x(0, 1));
    CHECK(end.v.cwiseAbs().maxCoeff() <= 1e-9);
    // The first step, of implicit Euler, is off by half of this, the last one, in which it stops, as well.
    CHECK(std::abs(end.x(0, 1) - speed * speed / (2 * mu * gravity)) <= mu * gravity * h * h);
  }
}

TEST_CASE("a slope holds a box up to mu = tan, and lets it go at g (sin - mu cos) beyond") {
  constexpr double angle = 0.3, h = 0.01;
  for (const Rule& rule : rules)
    for (const double share : {0.99, 1.01}) {
      const double mu = share * std::tan(angle);
      const Scene scene = pbdcheck::sliding_box(angle, mu, 0);
      const State end = run(scene, method_of(rule), h, 50);
      INFO(rule.integrator << " " << rule.rho << " " << share);
      const double speed = std::max(0.0, gravity * (std::sin(angle) - mu * std::cos(angle))) * 50 * h;
      CHECK(std::abs((end.v.col(1) - scene.initial.v.col(1)).norm() - speed) <= 1e-8);
    }
}
