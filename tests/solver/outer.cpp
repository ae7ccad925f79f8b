#include "outer/outer_names.h"

#include <catch2/catch.hpp>

#include "scenes.h"

using namespace pbd;
using namespace pbd::test;

TEST_CASE("plain converges to the equations of motion, incremental to another point of the manifold") {
  const Scene scene = chain(2);
  const double h = 1.0 / 60;
  const State start = advanced(scene, 1.0 / 240, 60);
  Method method = direct_method();
  method.outer = "plain";
  State plain = start, incremental = start;
  const Report exact = one_step(scene, method, h, plain);
  CHECK(exact.status == Status::ok);
  CHECK(exact.primal <= 1e-12 * exact.scale);
  method.outer = "incremental";
  const Report other = one_step(scene, method, h, incremental);
  CHECK(other.status == Status::not_converged);
  CHECK(other.dual <= 1e-12 * other.scale);
  CHECK(other.primal > 1e-4 * other.scale);
  // Both feel gravity: the two differ by less than they move (theory: a few percent).
  CHECK((plain.x - incremental.x).norm() < 0.1 * (plain.x - start.x).norm());
}

TEST_CASE("every outer iteration solves the step if it says so, and only then") {
  const double compliance = GENERATE(0.0, 1e-6);
  Scene scene = chain(2);
  for (double& each : std::get<Distance>(scene.effects[1]).compliance) each = compliance;
  const State start = advanced(scene, 1.0 / 240, 60);
  for (const auto& outer : outer_names()) {
    if (outer.name == "quasi_newton" && compliance == 0) continue;
    Method method = direct_method(1e-12);
    method.outer = outer.name;
    State state = start;
    INFO(outer.name << ", compliance " << compliance);
    CHECK((one_step(scene, method, 1.0 / 60, state).status == Status::ok) == outer.solves_step);
  }
}

// A stiff link that turns fast is longest where the free motion leads, and as long as it is to be at rest.
TEST_CASE("what has no finite mass goes on as it went, by every outer iteration") {
  Scene scene;
  add_node(scene, Vec3::Zero(), infinity, Vec3(0, 1, 0));
  add_node(scene, Vec3(1, 0, 0), 1, Vec3(0, 0, 8));
  scene.effects.emplace_back(Distance{.node = {{0, 1}}, .rest_length = {1}, .compliance = {1e-7}});
  for (const auto& outer : outer_names()) {
    Method method = direct_method();
    method.outer = outer.name;
    State state = scene.initial;
    INFO(outer.name);
    one_step(scene, method, 0.05, state);
    CHECK(state.v.col(0) == Vec3(0, 1, 0));
    CHECK(state.x.col(0) == Vec3(0, 0.05, 0));
  }
}

TEST_CASE("with directions that never change, incremental multipliers are as good as whole ones") {
  const Scene scene = cantilever(4, {1e5, 0.3}, Strain::linear);
  const std::string relaxation = GENERATE("direct", "gauss_seidel");
  Method method = direct_method(1e-12);
  method.relaxation = relaxation;
  State plain = scene.initial, incremental = scene.initial;
  one_step(scene, method, 1.0 / 60, plain);
  method.outer = "incremental";
  CHECK(one_step(scene, method, 1.0 / 60, incremental).status == Status::ok);
  CHECK((plain.x - incremental.x).norm() < 1e-10 * (plain.x - scene.initial.x).norm());
}

TEST_CASE("the plain iteration contracts a pendulum's error by h^2 T/(m l)") {
  const double h = GENERATE(0.2, 0.1, 0.05);
  const Scene scene = pendulum();
  State state = scene.initial;
  state.x.col(1) = Vec3(std::sin(0.4), 0, -std::cos(0.4));
  State solved = state;
  std::vector<Points> iterates;
  Method method = direct_method(1e-15);
  method.outer = "plain";
  Workspace workspace(scene, method);
  step(workspace, h, solved, [&](const Iterate& iterate) { iterates.push_back(iterate.x); });
  const double impulse = std::abs(workspace.impulses(1).at(0));
  const double predicted = h * impulse;  // lambda/(m l) with lambda = h p, m = 1 kg, l = 1 m
  std::vector<double> error;
  for (const auto& x : iterates)
    if (const double e = (x - solved.x).norm(); e > 1e-12) error.push_back(e);
  REQUIRE(error.size() >= 2);
  const double measured = error.back() / error[error.size() - 2];
  CHECK(measured == Approx(predicted).epsilon(0.01));
}

TEST_CASE("the proximal iteration solves a taut step where plain does not, whatever relaxes its rows") {
  const std::string relaxation =
      GENERATE("gauss_seidel", "jacobi", "nesterov_jacobi", "conjugate_gradients", "direct");
  const Scene scene = chain(10, 30);
  const State start = advanced(scene, 1.0 / 240, 60);
  Method method = direct_method(1e-11);
  method.relaxation = relaxation;
  method.max_sweeps = 200000;
  method.outer = "plain";
  State state = start;
  const Report plain = one_step(scene, method, 1.0 / 30, state);
  CHECK(plain.status == Status::not_converged);
  for (const std::string outer : {"proximal", "auto"}) {
    method.outer = outer;
    state = start;
    const Report report = one_step(scene, method, 1.0 / 30, state);
    INFO(relaxation << " " << outer);
    CHECK(report.status == Status::ok);
    CHECK(report.outer_iterations <= 60);
    CHECK(report.contraction > 1);
  }
}

// A strut that leans by 0.01 rad under its load: nothing is taut, and plain does not contract.
TEST_CASE("auto leaves plain where the step surprises its prediction") {
  Scene scene;
  scene.mass = {infinity, 1};
  scene.initial.x = Points::Zero(3, 2);
  scene.initial.x.col(1) = Vec3(1e-4, 0, 0.01);
  scene.initial.v = Points::Zero(3, 2);
  scene.effects.emplace_back(Gravity{});
  scene.effects.emplace_back(
      Distance{.node = {{0, 1}}, .rest_length = {scene.initial.x.col(1).norm()}, .compliance = {0}});
  const double h = 0.031;
  Method method = direct_method(1e-10);
  for (const std::string outer : {"plain", "auto"}) {
    method.outer = outer;
    State state = scene.initial;
    INFO(outer);
    CHECK((one_step(scene, method, h, state).status == Status::ok) == (outer == "auto"));
  }
}

TEST_CASE("where no constraint pulls, every outer iteration that solves the step takes plain's bits") {
  const double compliance = GENERATE(0.0, 1e-5);
  const std::string relaxation =
      GENERATE("gauss_seidel", "jacobi", "nesterov_jacobi", "conjugate_gradients", "direct");
  Scene scene = chain(4, 1, true);  // all numbers that make c are exact
  for (double& each : std::get<Distance>(scene.effects[1]).compliance) each = compliance;
  for (int node = 0; node < scene.nodes(); ++node) scene.initial.v.col(node) = Vec3(0.5, -0.25, 0.75);
  Method method;
  method.relaxation = relaxation;
  method.outer = "plain";
  State plain = scene.initial;
  one_step(scene, method, 1.0 / 128, plain);
  for (const auto& outer : outer_names()) {
    if (!outer.solves_step || (outer.name == "quasi_newton" && compliance == 0)) continue;
    method.outer = outer.name;
    State state = scene.initial;
    const Report report = one_step(scene, method, 1.0 / 128, state);
    INFO(outer.name << ", " << relaxation << ", compliance " << compliance);
    CHECK(report.status == Status::ok);
    CHECK(report.contraction == 0);
    CHECK(state.x == plain.x);
    CHECK(state.v == plain.v);
  }
}

TEST_CASE("quasi_newton finds plain's solution") {
  const auto strain = GENERATE(Strain::green, Strain::corotational, Strain::linear);
  const double poisson = GENERATE(0.3, 0.49);
  const Scene scene = cantilever(4, {1e6, poisson}, strain);
  Method method = direct_method(1e-11);
  method.max_outer = 1000;
  method.outer = "plain";
  State plain = scene.initial, state = scene.initial;
  REQUIRE(one_step(scene, method, 1.0 / 60, plain).status == Status::ok);
  method.outer = "quasi_newton";
  CHECK(one_step(scene, method, 1.0 / 60, state).status == Status::ok);
  CHECK((state.x - plain.x).norm() < 1e-9 * (plain.x - scene.initial.x).norm());
}

namespace {

/// A sheet of 1 kg held at its edges, its links `stretch` times as long as at rest, its middle thrown out of
/// its plane: iterations of quasi_newton to eight digits.
std::int64_t iterations_of_sheet(double stretch, double compliance) {
  constexpr int cells = 8;
  const TriangleMesh mesh = grid_sheet({cells, cells}, {1, 1});
  Scene scene;
  const int first = add_sheet_nodes(scene, mesh, 1);
  Distance links = sheet_links(mesh, first, compliance);
  for (double& length : links.rest_length) length /= stretch;
  scene.effects.emplace_back(std::move(links));
  for (int i = 0; i <= cells; ++i)
    for (int j = 0; j <= cells; ++j) {
      const int node = first + i + (cells + 1) * j;
      if (i % cells == 0 || j % cells == 0)
        scene.mass[static_cast<std::size_t>(node)] = infinity;
      else
        scene.initial.v(2, node) = 1 + 0.3 * std::sin(1.0 + i + 2 * j);
    }
  Method method = direct_method(1e-8);  // rounding of the stiffer ones leaves 1e-9
  method.outer = "quasi_newton";
  State state = scene.initial;
  const Report report = one_step(scene, method, 0.1, state);
  CHECK(report.status == Status::ok);
  return report.outer_iterations;
}

}  // namespace

TEST_CASE("on a taut sheet quasi_newton gains a digit in two iterations, however stiff its links") {
  CHECK(iterations_of_sheet(1.1, GENERATE(1e-3, 1e-6)) <= 2 * 8);
}

TEST_CASE(
    "on a sheet that is pressed by less than its mass holds quasi_newton gains a digit in an iteration") {
  // Eight links press a node by 0.1 of their stiffness, which times h^2 is half of a node's mass.
  const double node_mass = 1.0 / 64, stiffness = node_mass / 2 / (8 * 0.1 * 0.1 * 0.1);
  CHECK(iterations_of_sheet(0.9, 1 / stiffness) <= 8);
}

TEST_CASE("quasi_newton ends where rounding of positions leaves more of the residual than is asked") {
  // A sheet let go. Of positions of 1 m 1e-16 m are lost, which times a link's 1e5 N/m and the step, over the
  // root of a node's 1e-4 kg, make 2e-11 a node, and 1e-8 of the scale in sum.
  constexpr int digits = 12;
  Method method = direct_method(std::pow(10, -digits));
  method.outer = "quasi_newton";
  const Scene scene = pbdcheck::cloth(40);
  State state = scene.initial;
  const Report report = one_step(scene, method, 1.0 / 60, state);
  CHECK(report.status == Status::ok);
  CHECK(report.outer_iterations <= 2 * digits);
}

TEST_CASE("auto goes on by another iteration where quasi_newton is far from the solution") {
  // Three stiff springs, far from their lengths, thrown.
  const std::array<Vec3, 3> x{Vec3(0.080116, 0.074921, 0.0885), Vec3(-0.061952, -0.048636, -0.082116),
                              Vec3(0.055101, 0.037721, 0.039507)};
  Scene scene;
  add_node(scene, x[0], infinity);
  add_node(scene, x[1], 1.296, Vec3(-0.3131, -0.8265, -1.398));
  add_node(scene, x[2], 0.1388, Vec3(2.159, -2.267, 3.378));
  scene.effects.emplace_back(
      Distance{{{0, 1}, {0, 2}, {1, 2}}, {0.01171, 0, (x[2] - x[1]).norm()}, {1.304e-7, 1.365e-7, 1.365e-7}});
  scene.effects.emplace_back(Gravity{});
  constexpr int steps = 15;
  const auto solved = [&](const char* outer) {
    Method method = direct_method(1.7e-6);
    method.outer = outer;
    Workspace workspace(scene, method);
    State state = scene.initial;
    int ok = 0;
    for (int k = 0; k < steps; ++k) ok += step(workspace, 0.004, state).status == Status::ok;
    return ok;
  };
  CHECK(solved("quasi_newton") < steps);
  CHECK(solved("auto") == steps);
}

TEST_CASE("quasi_newton keeps hard rows dual, beside compliant ones and alone") {
  // A cantilever whose end carries a rope of hard links, and the rope alone on a fixed node.
  Scene scene = cantilever(4, {1e6, 0.3}, GENERATE(Strain::green, Strain::corotational));
  if (GENERATE(true, false))
    scene = {
        .mass = {infinity}, .initial = {0, Points::Zero(3, 1), Points::Zero(3, 1)}, .effects = {Gravity{}}};
  Distance rope;
  int last = scene.nodes() - 1;
  for (int link = 0; link < 5; ++link) {
    const int next = add_node(scene, scene.initial.x.col(last) + Vec3(0.08, 0, -0.06), 1, {0, 1, 0});
    rope.node.push_back({last, next});
    rope.rest_length.push_back(0.1);
    rope.compliance.push_back(0);
    last = next;
  }
  scene.effects.emplace_back(rope);
  Method method = direct_method(1e-10);
  method.outer = "proximal";
  State exact = scene.initial, state = scene.initial;
  REQUIRE(one_step(scene, method, 1.0 / 240, exact).status == Status::ok);
  method.outer = "quasi_newton";
  const Report report = one_step(scene, method, 1.0 / 240, state);
  INFO(report.reason << ", " << report.outer_iterations << " iterations, residual " << report.residual());
  CHECK(report.status == Status::ok);
  CHECK((state.x - exact.x).norm() < 1e-9 * (exact.x - scene.initial.x).norm());
}

TEST_CASE("frozen solves one linearisation and says that the nonlinear step is not solved") {
  const Scene scene = pendulum();
  State state = scene.initial;
  Method method = direct_method(1e-10);
  method.outer = "frozen";
  const Report report = one_step(scene, method, 0.1, state);
  CHECK(report.status == Status::not_converged);
  // Linearised at (1, 0, 0) the link holds x; the fall is free: z = -g h^2.
  CHECK(state.x(0, 1) == Approx(1).epsilon(1e-12));
  CHECK(state.x(2, 1) == Approx(-9.81 * 0.01).epsilon(1e-12));
}
