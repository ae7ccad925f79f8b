// Steps by vertex block descent beside known answers, beside block Gauss-Seidel and beside Newton's.
#include "rivals/vbd.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "mesh.h"
#include "rival_refusals.h"
#include "rivals/implicit_step.h"
#include "rivals/newton.h"
#include "rivals/potential.h"
#include "scenes/standard.h"

using namespace pbd;
using namespace pbd::rivals;

namespace {

constexpr double vbd_step_s = 1.0 / 60;

/// Its iterates, the first one being y.
std::vector<Points> iterates_of(const Scene& scene, int sweeps, double tolerance = 0) {
  std::vector<Points> all;
  State state = scene.initial;
  vbd(scene, vbd_step_s)->step(state, {tolerance, sweeps}, [&](const Iterate& iterate) {
    all.push_back(iterate.x);
  });
  return all;
}

/// phi's gradient (N) and value (J) there.
Point at(const Scene& scene, const Points& x) {
  ImplicitStep step("test", scene, vbd_step_s);
  step.begin(scene.initial);
  const Potential potential("test", scene, std::vector<int>(static_cast<std::size_t>(scene.nodes()), -1));
  Point point{x, {}, 0};
  step.evaluate(potential, point);
  return point;
}

State newton_end(const Scene& scene) {
  State state = scene.initial;
  REQUIRE(newton(scene, vbd_step_s)->step(state, {1e-13, 100}).status == Status::ok);
  return state;
}

}  // namespace

TEST_CASE("two masses on a spring come nearer to their step by (k/(k + m/h^2))^2 a sweep of VBD") {
  constexpr double mass = 0.5, length = 1, stretch = 0.1, stiffness = 4000;
  Scene scene;
  add_node(scene, Vec3::Zero(), mass);
  add_node(scene, Vec3(length + stretch, 0, 0), mass);
  scene.effects.emplace_back(
      Distance{.node = {{0, 1}}, .rest_length = {length}, .compliance = {1 / stiffness}});
  // By symmetry, m/h^2 d + 2 k (d - stretch) = 0 of what each one moves, twice.
  const double inertia = mass / (vbd_step_s * vbd_step_s);
  const double moved = stiffness * stretch / (inertia + 2 * stiffness);
  const auto apart = [&](const Points& x) { return std::abs(x(0, 1) - (length + stretch - moved)); };
  const auto found = iterates_of(scene, 10);
  const double rate = std::pow(stiffness / (stiffness + inertia), 2);
  for (std::size_t k = 2; k < found.size(); ++k)
    CHECK(apart(found[k]) == Approx(rate * apart(found[k - 1])).margin(1e-14));
}

TEST_CASE("a sweep of VBD over a linear solid is one of block Gauss-Seidel") {
  const Scene scene = pbdcheck::cantilever(4, {1e5, 0.3}, Strain::linear);
  const int nodes = scene.nodes(), size = 3 * nodes;
  // Of a quadratic function differences of the gradient are its matrix.
  const Points origin = scene.initial.x;
  const Eigen::VectorXd begin = at(scene, origin).gradient.reshaped();
  Eigen::MatrixXd matrix(size, size);
  for (int k = 0; k < size; ++k) {
    Points moved = origin;
    moved.reshaped()(k) += 1;
    matrix.col(k) = at(scene, moved).gradient.reshaped() - begin;
  }
  const auto found = iterates_of(scene, 3);
  REQUIRE(found.size() == 4);
  Points x = found[0];
  for (std::size_t sweep = 1; sweep < found.size(); ++sweep) {
    for (int i = 0; i < nodes; ++i) {
      if (std::isinf(scene.mass[static_cast<std::size_t>(i)])) continue;
      const Eigen::VectorXd gradient = begin + matrix * (x - origin).reshaped();
      x.col(i) -= matrix.block<3, 3>(3 * i, 3 * i).inverse() * gradient.segment<3>(3 * i);
    }
    CHECK((found[sweep] - x).norm() <= 1e-9 * (found[sweep] - found[0]).norm());
  }
}

TEST_CASE("VBD lowers the energy in each sweep, and ends where Newton does") {
  const auto solves = [](const Scene& scene) {
    State state = scene.initial;
    const Report report = vbd(scene, vbd_step_s)->step(state, {1e-12, 20000});
    CHECK(report.status == Status::ok);
    const State exact = newton_end(scene);
    CHECK((state.x - exact.x).norm() <= 1e-9 * (exact.x - scene.initial.x).norm());
    double last = infinity;
    for (const Points& x : iterates_of(scene, 30)) {
      const double phi = at(scene, x).phi;
      CHECK(phi < last);
      last = phi;
    }
  };
  for (const Strain strain : {Strain::green, Strain::corotational, Strain::linear})
    solves(pbdcheck::cantilever(8, {1e5, 0.3}, strain));
}

TEST_CASE("VBD solves a step of cloth, which bends") {
  const Scene scene = pbdcheck::cloth(4, false);
  State state = scene.initial;
  const Report report = vbd(scene, vbd_step_s)->step(state, {1e-9, 20000});
  CHECK(report.status == Status::ok);
  const State exact = newton_end(scene);
  CHECK((state.x - exact.x).norm() <= 1e-6 * (exact.x - scene.initial.x).norm());
}

TEST_CASE("VBD leaves a node whose matrix is singular where it is, and refuses in its own name") {
  Scene scene;
  add_node(scene, Vec3::Zero(), infinity);
  add_node(scene, Vec3(1, 0, 0), 1);
  scene.effects.emplace_back(Distance{.node = {{0, 1}}, .rest_length = {1}, .compliance = {0}});
  CHECK(test::refusal(vbd, scene, 0.01) ==
        "vbd: distance compliance[0]: got 0; allowed: a number > 0: no hard constraints");
  CHECK(test::refusal(vbd, scene, 0).rfind("vbd: h: got 0", 0) == 0);
  // Pressed together by a force equal to m/h^2 across: nothing holds the node there.
  const double inertia = 1 / (vbd_step_s * vbd_step_s);
  std::get<Distance>(scene.effects[0]) = {.node = {{0, 1}}, .rest_length = {2}, .compliance = {1 / inertia}};
  State state = scene.initial;
  const Report report = vbd(scene, vbd_step_s)->step(state, {1e-12, 10});
  CHECK(report.status == Status::not_converged);
  CHECK(report.reason == "sweeps change nothing more");
  CHECK((state.x - scene.initial.x).norm() == 0);
}
