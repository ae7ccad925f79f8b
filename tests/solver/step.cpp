#include "step/step.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <numbers>

#include "outer/outer_names.h"
#include "scenes.h"
#include "step/integrators.h"

using namespace pbd;
using namespace pbd::test;

TEST_CASE("free fall is implicit Euler's to rounding: it lags by g h t / 2") {
  Scene scene;
  add_node(scene, Vec3::Zero(), 2);
  scene.effects.emplace_back(Gravity{});
  const double h = 0.01;
  State state = scene.initial;
  Workspace workspace(scene, {});
  for (int k = 0; k < 100; ++k) CHECK(step(workspace, h, state).status == Status::ok);
  CHECK(state.x(2, 0) == Approx(-9.81 / 2 - 9.81 * h / 2).epsilon(1e-13));
  CHECK(state.time == Approx(1).epsilon(1e-14));
}

TEST_CASE("static stretch of a compliant link is m g A whatever the step") {
  const double h = GENERATE(1e-3, 1e-1, 10.0);
  Scene scene;
  add_node(scene, Vec3::Zero(), infinity);
  add_node(scene, Vec3(0, 0, -1), 1);
  scene.effects.emplace_back(Gravity{});
  scene.effects.emplace_back(Distance{.node = {{0, 1}}, .rest_length = {1}, .compliance = {1e-4}});
  State state = scene.initial;
  state.x(2, 1) = -1 - 9.81e-4;
  const auto report = one_step(scene, direct_method(), h, state);
  CHECK(report.status == Status::ok);
  CHECK(-state.x(2, 1) - 1 == Approx(9.81e-4).epsilon(1e-9));
  CHECK(state.v.norm() < 1e-9);
}

TEST_CASE("a step that is not solvable says so") {
  Scene scene = pendulum();
  SECTION("a stretched link between two fixed nodes") {
    scene.mass[1] = infinity;
    scene.initial.x(0, 1) = 2;
    add_node(scene, Vec3(5, 0, 0), 1);
    State state = scene.initial;
    CHECK(one_step(scene, {}, 0.01, state).status == Status::not_converged);
  }
  SECTION("a stretched link and nothing that moves") {
    scene.mass[1] = infinity;
    scene.initial.x(0, 1) = 2;
    State state = scene.initial;
    CHECK(one_step(scene, {}, 0.01, state).status == Status::not_converged);
  }
  SECTION("a far node that no constraint touches does not hide the others' residual") {
    add_node(scene, Vec3(1e12, 0, 0), 1);
    Method method;
    method.max_outer = 1;
    State state = scene.initial;
    CHECK(one_step(scene, method, 0.1, state).status == Status::not_converged);
  }
  SECTION("a budget too small") {
    Method method;
    method.max_outer = 1;
    method.max_sweeps = 1;
    method.tolerance = 1e-14;
    State state = scene.initial;
    const Report report = one_step(chain(20), method, 0.01, state = chain(20).initial);
    CHECK(report.status == Status::not_converged);
    CHECK(report.residual() > method.tolerance);
  }
  SECTION("overflow leaves the state as it was") {
    State state = scene.initial;
    state.v(2, 1) = 1e300;
    const State before = state;
    CHECK(one_step(scene, {}, 0.01, state).status == Status::diverged);
    CHECK(state.x == before.x);
    CHECK(state.time == before.time);
  }
}

TEST_CASE("an empty effect changes no bit and adds no rows") {
  const Scene scene = chain(20);
  Scene padded = scene;
  padded.effects.insert(padded.effects.begin(), Bending{});
  padded.effects.emplace_back(TetStrain{});
  padded.effects.emplace_back(ExternalForce{});
  for (const std::string relaxation :
       {"gauss_seidel", "jacobi", "nesterov_jacobi", "conjugate_gradients", "direct"}) {
    Method method;
    method.relaxation = relaxation;
    Workspace plain_workspace(scene, method), padded_workspace(padded, method);
    State a = scene.initial, b = padded.initial;
    for (int k = 0; k < 20; ++k) {
      step(plain_workspace, 1.0 / 240, a);
      step(padded_workspace, 1.0 / 240, b);
    }
    INFO(relaxation);
    CHECK(a.x == b.x);
    CHECK(a.v == b.v);
    CHECK(padded_workspace.costs().size() == plain_workspace.costs().size());
  }
}

TEST_CASE("warm starting changes the path, not the solution") {
  const Scene scene = cantilever(4, {1e5, 0.3}, Strain::corotational);
  State warm = scene.initial, cold = scene.initial;
  Method method = direct_method(1e-12);
  Workspace warm_workspace(scene, method);
  for (int k = 0; k < 5; ++k) step(warm_workspace, 0.01, warm);
  method.warm_start = false;
  Workspace cold_workspace(scene, method);
  for (int k = 0; k < 5; ++k) step(cold_workspace, 0.01, cold);
  CHECK((warm.x - cold.x).norm() < 1e-10 * (warm.x - scene.initial.x).norm());
}

TEST_CASE("dimensionless results do not change with the units of length, mass and time") {
  const double length = GENERATE(1e-3, 1.0, 1e3);
  const double mass = GENERATE(1e-6, 1.0, 1e6);
  const double time = GENERATE(1e-3, 1.0, 1e3);
  const auto displacement = [](double l, double m, double t) {
    Scene scene;
    scene.effects.emplace_back(Gravity{.acceleration = Vec3(0, 0, -9.81) * l / (t * t)});
    const double pressure = m / (l * t * t);
    add_solid(scene, kuhn_grid({4, 1, 1}, l * Vec3(1, 0.25, 0.25)), 1000 * m / (l * l * l),
              {1e5 * pressure, 0.3}, Strain::corotational);
    for (int node = 0; node < scene.nodes(); ++node)
      if (scene.initial.x(0, node) == 0) scene.mass[static_cast<std::size_t>(node)] = infinity;
    const int tip = scene.nodes() - 1;
    const int bob = add_node(scene, scene.initial.x.col(tip) + l * Vec3(0.1, 0, 0), 5 * m);
    scene.effects.emplace_back(Distance{.node = {{tip, bob}}, .rest_length = {0.1 * l}, .compliance = {0}});
    State state = scene.initial;
    Method method = direct_method(1e-12);
    Workspace workspace(scene, method);
    for (int k = 0; k < 10; ++k) step(workspace, t / 240, state);
    return Points((state.x - scene.initial.x) / l);
  };
  const Points expected = displacement(1, 1, 1);
  CHECK((displacement(length, mass, time) - expected).norm() < 1e-9 * expected.norm());
}

TEST_CASE("unknown names are refused before anything is computed") {
  Method method;
  method.outer = "newton";
  CHECK_THROWS_WITH(Workspace(pendulum(), method), Catch::Contains("outer") && Catch::Contains("plain"));
  method = {};
  method.integrator = "rk4";
  CHECK_THROWS_WITH(Workspace(pendulum(), method), Catch::Contains("integrator"));
}

TEST_CASE("a step begins with the last impulses if warm, with none if cold") {
  // A weight at rest on a hard link: the impulse of one step, h m g, is that of the next.
  Scene scene;
  add_node(scene, Vec3::Zero(), infinity);
  add_node(scene, Vec3(0, 0, -1), 1);
  scene.effects.emplace_back(Gravity{});
  scene.effects.emplace_back(Distance{.node = {{0, 1}}, .rest_length = {1}, .compliance = {0}});
  const double h = 0.01;
  Method method = direct_method(1e-12);
  method.warm_start = GENERATE(true, false);
  Workspace workspace(scene, method);
  State state = scene.initial;
  step(workspace, h, state);
  double first = -1;
  step(workspace, h, state, [&](const Iterate& iterate) {
    if (iterate.outer_iteration == 0) first = iterate.primal;
  });
  // |v - v_free - W J^T p|_M of the old velocity, 0: nothing is left if p = h m g, h g sqrt(m) if p = 0.
  CHECK(first == Approx(method.warm_start ? 0 : 9.81 * h).margin(1e-12));
}

TEST_CASE("a diverged step leaves nothing behind in the workspace") {
  const Scene scene = chain(4);
  const Method method;
  Workspace used(scene, method), fresh(scene, method);
  State broken = scene.initial;
  step(used, 0.01, broken);
  broken.v(2, 1) = 1e300;
  CHECK(step(used, 0.01, broken).status == Status::diverged);
  State after = scene.initial, expected = scene.initial;
  step(used, 0.01, after);
  step(fresh, 0.01, expected);
  CHECK(after.x == expected.x);
  CHECK(after.v == expected.v);
}

TEST_CASE("a step that makes no sense is refused, and the state kept") {
  Scene scene = chain(2);
  add_body(scene, Vec3::Zero(), 1, Vec3::Ones());
  Workspace workspace(scene, Method{});
  for (const double h : {0.0, -1e-9, 5e-324, infinity, std::nan("")}) {
    State state = scene.initial;
    CHECK_THROWS_WITH(step(workspace, h, state), Catch::Contains("h") && Catch::Contains("above 0 s"));
  }
  State state = scene.initial;
  CHECK_THROWS_WITH(step(workspace, -1e-9, state), Catch::Contains("e-"));
  state.orientation[0].coeffs() *= 1 + 1e-8;
  const State before = state;
  CHECK_THROWS_WITH(step(workspace, 0.01, state),
                    Catch::Contains("state.orientation[0]") && Catch::Contains("1.00000000"));
  CHECK(state.x == before.x);
  state = scene.initial;
  state.v.conservativeResize(3, 2);
  CHECK_THROWS_WITH(step(workspace, 0.01, state), Catch::Contains("state.v") && Catch::Contains("2 entries"));
}

TEST_CASE("a scene that makes no sense is refused before anything is computed") {
  Scene scene = pendulum();
  SECTION("a mass of zero") {
    scene.mass[1] = 0;
    CHECK_THROWS_WITH(Workspace(scene, {}), Catch::Contains("mass[1]"));
  }
  SECTION("a mass whose products underflow") {
    scene.mass[1] = 1e-200;
    CHECK_THROWS_WITH(Workspace(scene, {}), Catch::Contains("mass[1]") && Catch::Contains("1e-100"));
  }
  SECTION("a speed beyond rounding") {
    scene.initial.v.col(1) = Vec3(0, 0, -1e18);
    CHECK_THROWS_WITH(Workspace(scene, {}), Catch::Contains("velocity[1]") && Catch::Contains("m/s"));
  }
  SECTION("a link to a node that is not there") {
    scene.effects.emplace_back(Distance{.node = {{0, 2}}, .rest_length = {1}, .compliance = {0}});
    CHECK_THROWS_WITH(Workspace(scene, {}), Catch::Contains("effects[2] distance node[0]"));
  }
}
