// Where a step takes its constraints' directions: at its end, at its begin, between; and velocity time
// stepping.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "scenes.h"

using namespace pbd;
using namespace pbd::test;

namespace {

/// Energy (J, zero where it is released) of a pendulum released horizontally after each step of h seconds.
std::vector<double> energies(const Method& method, double h, int steps) {
  const Scene scene = pbdcheck::pendulum(std::numbers::pi / 2, 0);
  Workspace workspace(scene, method);
  State state = scene.initial;
  std::vector<double> found{0};
  int missed = 0;
  for (int k = 0; k < steps; ++k) {
    missed += step(workspace, h, state).status != Status::ok;
    found.push_back(state.v.col(1).squaredNorm() / 2 + gravity * state.x(2, 1));
  }
  CHECK(missed == 0);
  return found;
}

/// A bob 1 m beyond a link of 1 m, at rest, and nothing that pulls.
Scene stretched_link(double compliance) {
  Scene scene;
  add_node(scene, Vec3::Zero(), infinity);
  add_node(scene, Vec3(2, 0, 0), 1);
  scene.effects.emplace_back(Distance{.node = {{0, 1}}, .rest_length = {1}, .compliance = {compliance}});
  return scene;
}

}  // namespace

TEST_CASE(
    "directions at the step's begin keep a pendulum's energy in a band, those at its end take from it") {
  const double h = 1.0 / 60;
  const int steps = 600;
  Method method = direct_method(1e-11);
  const auto implicit = energies(method, h, steps);
  // A taut link's value is convex, so that its force does no work or takes some in every step.
  CHECK(std::is_sorted(implicit.rbegin(), implicit.rend()));

  // Symplectic Euler conserves E - h/2 v.dU/dx + O(h^2), and dU/dx = m g along z. The pendulum's largest v_z,
  // sqrt(2 g l cos(phi)) sin(phi) at cos(phi)^2 = 1/3, bounds the band.
  method.direction_blend = 0;
  const double fastest_fall = std::sqrt(2 * gravity / std::sqrt(3.0)) * std::sqrt(2.0 / 3);
  const double band = h / 2 * gravity * fastest_fall;
  double largest = 0;
  for (const double energy : energies(method, h, steps)) largest = std::max(largest, std::abs(energy));
  CHECK(largest < 1.1 * band);

  method.direction_blend = 0.5;
  const auto between = energies(method, h, steps);
  CHECK(between.back() < -10 * band);
  CHECK(implicit.back() < between.back());
}

TEST_CASE("blended directions are those at the blended positions, in rows and impulses") {
  // After one step from rest: x on the circle, and x - y along the blended direction, y the free fall.
  const double h = 0.2, blend = GENERATE(0.0, 0.3, 1.0);
  const Scene scene = pbdcheck::pendulum(1, 0);
  Method method = direct_method(1e-11);
  method.direction_blend = blend;
  for (const std::string outer : {"plain", "proximal", "auto"}) {
    method.outer = outer;
    State state = scene.initial;
    Workspace workspace(scene, method);
    CHECK(step(workspace, h, state).status == Status::ok);
    const Vec3 begin = scene.initial.x.col(1), end = state.x.col(1);
    const Vec3 pulled = end - (begin - gravity * h * h * Vec3::UnitZ());
    const Vec3 direction = (begin + blend * (end - begin)).normalized();
    INFO(outer << ", blend " << blend);
    CHECK(end.norm() == Approx(1).epsilon(1e-10));
    CHECK(pulled.norm() > 0.1);
    CHECK((pulled - pulled.dot(direction) * direction).norm() < 1e-10);
  }
}

TEST_CASE("symplectic_euler takes the directions at the step's begin, whatever the blend") {
  Method shake = direct_method(1e-11), symplectic = direct_method(1e-11);
  shake.direction_blend = 0;
  symplectic.integrator = "symplectic_euler";
  CHECK(energies(shake, 1.0 / 60, 100) == energies(symplectic, 1.0 / 60, 100));
}

TEST_CASE("a potential has its own directions: quasi_newton refuses others, auto takes another way") {
  const Scene scene = cantilever(4, {1e6, 0.3}, Strain::green);
  Method method;
  method.direction_blend = 0.5;
  method.relaxation = "direct";
  State state = scene.initial;
  Workspace workspace(scene, method);
  CHECK(step(workspace, 1.0 / 60, state).status == Status::ok);
  method.outer = "quasi_newton";
  CHECK_THROWS_WITH(Workspace(scene, method), Catch::Contains("directions that are not those at x"));
  method.direction_blend = 1;
  method.integrator = "symplectic_euler";
  CHECK_THROWS_WITH(Workspace(scene, method), Catch::Contains("directions that are not those at x"));
}

TEST_CASE("frozen removes its share of a hard link's error a step, and says unless that was all") {
  const double share = GENERATE(0.0, 0.2, 1.0), h = 0.1;
  Method method = direct_method(1e-11);
  method.outer = "frozen";
  method.stabilisation = share;
  const Scene hard = stretched_link(0);
  State state = hard.initial;
  Workspace workspace(hard, method);
  for (int k = 1; k <= 3; ++k) {
    const double before = state.x(0, 1) - 1;
    state.v.setZero();
    const Status status = step(workspace, h, state).status;
    CHECK(state.x(0, 1) - 1 == Approx((1 - share) * before).margin(1e-12));
    CHECK((status == Status::ok) == (share == 1));
  }
  // A spring's value is no error: k = 1/A pulls whatever the share. M v + h k (c + h v) = 0.
  const Scene soft = stretched_link(0.5);
  State sprung = soft.initial;
  Workspace other(soft, method);
  CHECK(step(other, h, sprung).status == Status::ok);
  CHECK(sprung.v(0, 1) == Approx(-h * 2 / (1 + h * h * 2)).epsilon(1e-12));
}

TEST_CASE("frozen without stabilisation leaves the circle by h v a step") {
  const double h = 0.05, rate = 2;
  Scene scene = pbdcheck::pendulum(0.5, rate);
  scene.effects.erase(scene.effects.begin());  // no gravity: the speed stays
  Method method = direct_method(1e-11);
  method.outer = "frozen";
  method.stabilisation = 0;
  State state = scene.initial;
  Workspace workspace(scene, method);
  for (int k = 1; k <= 10; ++k) {
    const double before = state.x.col(1).squaredNorm();
    CHECK(step(workspace, h, state).status == Status::not_converged);
    const double travelled = h * state.v.col(1).norm();
    CHECK(state.x.col(1).squaredNorm() == Approx(before + travelled * travelled).epsilon(1e-12));
  }
}
