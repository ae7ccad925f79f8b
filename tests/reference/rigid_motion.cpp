// Motions of rigid bodies against formulas, other equations of the same motion and stated values.
#include "rigid_motion.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>

#include "body_scenes.h"
#include "closed_form.h"
#include "closed_form_bodies.h"
#include "error.h"
#include "ode.h"
#include "plane_mechanism.h"
#include "scenes/mechanisms.h"

using namespace pbd;
using namespace pbd::reference;
using namespace pbd::test;
using pbdcheck::andrews_squeezer;
using pbdcheck::four_bars;

namespace {

Trajectory solved_motion(const Scene& scene, const std::vector<double>& times) {
  Trajectory trajectory = ode(scene, times);
  INFO(trajectory.reason);
  REQUIRE(trajectory.outcome == Outcome::ok);
  REQUIRE(trajectory.samples.size() == times.size());
  return trajectory;
}

/// Bob of 1 m and 1 kg on a massless rod about z, from rest at the horizontal; its own inertia does not turn
/// since a point has none: a body that keeps its orientation, on a link.
Scene bob() {
  Scene scene;
  const int world = add_world(scene);
  const int body = add_body(scene, Vec3(-1, 0, 0), 1, Vec3::Constant(infinity));
  scene.effects = {Gravity{}, BodyDistance{{{world, body}}, {{Vec3::Zero(), Vec3::Zero()}}, {1}, {0}}};
  return scene;
}

}  // namespace

TEST_CASE("Jacobi's functions give the spin of every free body") {
  int circled = 0;
  for (int seed = 0; seed < 60; ++seed) {
    const auto number = [&](int k) { return std::sin(1.7 * seed + 2.3 * k); };
    Vec3 inertia(1, 2, 2.5);
    const int order = seed % 6;
    if (order % 2 == 1) std::swap(inertia[0], inertia[1]);
    std::rotate(inertia.begin(), inertia.begin() + order / 2, inertia.end());
    if (seed >= 40) inertia[seed % 3] = inertia[(seed + 1) % 3];  // symmetric, or a sphere by chance
    const Vec3 spin(3 * number(0), 3 * number(1), 3 * number(2));
    const auto slope = [&](double, const Vector& y, Vector& out) {
      const Vec3 w = y;
      out = Vec3(inertia.cwiseProduct(w)).cross(w).cwiseQuotient(inertia);
    };
    const double period = free_body_period(inertia, spin);
    for (const double time : {0.0, 0.3, 2.0}) {
      const Vec3 expected = solve_ode(slope, spin, {time}).states.back();
      INFO(seed << " at " << time << ", moments " << inertia.transpose());
      CHECK((free_body_spin(inertia, spin, time) - expected).norm() <= 1e-10 * spin.norm());
    }
    if (std::isfinite(period)) {
      CHECK((free_body_spin(inertia, spin, period) - spin).norm() <= 1e-9);
      CHECK((free_body_spin(inertia, spin, period / 2) - spin).norm() > 1e-3);
      ++circled;
    }
  }
  CHECK(circled > 40);
  CHECK(free_body_spin(Vec3(1, 2, 3), Vec3(0, 2, 0), 5) == Vec3(0, 2, 0));
}

TEST_CASE("a free body spins as the formula says and keeps its angular momentum in space") {
  const std::vector<double> times{1, 3, 10};
  for (const auto& [inertia, spin] :
       {std::pair{Vec3(1, 2, 3), Vec3(1, 1, 1)}, {Vec3(1, 1, 2), Vec3(0.5, 0, 10)}}) {
    Scene scene;
    const Eigen::Quaterniond turn(0.5, 0.5, -0.5, 0.5);
    add_body(scene, Vec3(1, 2, 3), 2, inertia, turn, Vec3(0, 1, 0), spin);
    scene.effects = {Gyroscopic{}};
    const Trajectory found = solved_motion(scene, times);
    const Vec3 momentum = turn * inertia.cwiseProduct(spin);
    for (std::size_t i = 0; i < times.size(); ++i) {
      const State& state = found.samples[i];
      CHECK((state.spin.col(0) - free_body_spin(inertia, spin, times[i])).norm() <= 1e-9);
      CHECK((state.orientation[0] * inertia.cwiseProduct(Vec3(state.spin.col(0))) - momentum).norm() <= 1e-9);
      CHECK((state.x.col(0) - Vec3(1, 2 + times[i], 3)).norm() <= 1e-12);
    }
    REQUIRE(found.energy_drift);
    CHECK(*found.energy_drift <= 1e-11);
    if (inertia[0] == inertia[1]) {
      // Its axis circles the momentum at L/I1.
      const Vec3 axis = turn * Vec3::UnitZ(), along = momentum.normalized();
      const Eigen::AngleAxisd circled(space_precession(1, 2, spin) * times[0], along);
      CHECK((found.samples[0].orientation[0] * Vec3::UnitZ() - circled * axis).norm() <= 1e-9);
    }
  }
}

TEST_CASE("a bob on a rod swings as the elliptic functions say, a rod as the bob of two thirds") {
  const std::vector<double> times{1, 2, 5, 9.99};
  const Trajectory found = solved_motion(bob(), times);
  REQUIRE(found.position_drift);
  CHECK(*found.position_drift <= 1e-10);
  CHECK(*found.energy_drift <= 1e-10);
  PlaneMechanism m;
  const int rod = m.body(-0.5, 0, std::numbers::pi, 1, 1.0 / 12);
  m.hinge(m.world, rod, 0, 0);
  m.scene.effects = {Gravity{Vec3(0, -9.81, 0)}};
  const Trajectory swung = solved_motion(m.finished(), times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Angle exact = pendulum_motion(1, 9.81, std::numbers::pi / 2, times[i]);
    const Vec3 x(-std::sin(exact.angle), 0, -std::cos(exact.angle));
    CHECK((found.samples[i].x.col(1) - x).norm() <= 1e-9);
    CHECK((found.samples[i].x.col(1) - x).norm() <= 2 * found.position_error[i] + 1e-12);
    const Angle slow = pendulum_motion(rod_pendulum_length(1), 9.81, std::numbers::pi / 2, times[i]);
    CHECK(swung.samples[i].spin(2, 1) == Approx(-slow.rate).margin(1e-8));
  }
}

TEST_CASE("a heavy top precesses steadily at both rates") {
  const HeavyTop top{0.0125, 0.005, 0.981};
  const double tilt = std::numbers::pi / 6, spin = 100;
  const Precession rates = steady_precession(top, tilt, spin);
  for (const double rate : {rates.slow, rates.fast}) {
    // The frame's third axis tilted about y from the upright; it turns with w = rate vertical + ... and w3 =
    // spin.
    Scene scene;
    const int world = add_world(scene);
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(tilt, Vec3::UnitY()));
    const Vec3 axis = turn * Vec3::UnitZ(), x = 0.1 * axis;
    const Vec3 w(-rate * std::sin(tilt), 0, spin);
    const int disc = add_body(scene, x, 1, Vec3(0.0025, 0.0025, 0.005), turn, (turn * w).cross(x), w);
    PointJoint ball;
    join(ball, world, disc, Vec3::Zero(), Vec3(0, 0, -0.1));
    scene.effects = {Gravity{}, Gyroscopic{}, ball};
    for (const Trajectory found = solved_motion(scene, {0.05, 0.2}); const State& state : found.samples) {
      const Eigen::AngleAxisd turned(rate * state.time, Vec3::UnitZ());
      CHECK((state.orientation[1] * Vec3::UnitZ() - turned * axis).norm() <= 1e-8);
    }
  }
}

TEST_CASE("a linkage with redundant hinges moves as its single angle") {
  // Upright to where its rods are not yet in line: angle'' = -(G/I) cos(angle).
  for (const int loops : {1, 2}) {
    const double inertia = (loops + 1) / 3.0 + loops, weight = ((loops + 1) / 2.0 + loops) * 9.81;
    const std::vector<double> times{0.1, 0.3};
    const Trajectory found = solved_motion(four_bars(loops), times);
    for (std::size_t i = 0; i < times.size(); ++i) {
      const Direction crank = circling_pendulum(inertia / weight * 9.81, 9.81, 1, times[i]);
      const Vec3 end = found.samples[i].x.col(1) * 2;
      CHECK((end - Vec3(-crank.sine, -crank.cosine, 0)).norm() <= 1e-9);
    }
  }
}

TEST_CASE("Andrews' squeezer starts and moves as stated") {
  const Scene scene = andrews_squeezer();
  const RigidMotion motion(scene);
  const Vector start = motion.start();
  Vector slope = Vector::Zero(start.size());
  motion.slope(0, start, slope);
  // Spins follow the velocities of the seven centres; w3 of the crank and of the coupler.
  const int spins = 21 + 21;
  CHECK(slope(spins + 2) == Approx(14222.44391995).epsilon(1e-9));
  CHECK(slope(spins + 5) == Approx(14222.44391995 - 10666.83293997).epsilon(1e-9));
  const std::vector<Vec3> stated{{0.0068446418, 0.0014665876, 0},
                                 {-0.0038905524, 0.0058192441, 0},
                                 {-0.0022744209, 0.0066201971, 0},
                                 {-0.0069630394, -0.0007183884, 0}};
  const Trajectory found = solved_motion(scene, {0.005, 0.01, 0.02, 0.03});
  for (std::size_t i = 0; i < stated.size(); ++i) {
    const State& state = found.samples[i];
    const Vec3 end = state.x.col(1) + state.orientation[1] * Vec3(0.007 - 0.00092, 0, 0);
    CHECK((end - stated[i]).norm() <= 1e-9);
  }
  // The crank has turned by the angle of the test set's last digits, up to full turns.
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(15.81077119629904, Vec3::UnitZ()));
  CHECK(found.samples[3].orientation[1].angularDistance(turned) <= 1e-8);
}

TEST_CASE("energy is told where nothing without a potential does work") {
  PlaneMechanism m;
  const int rod = m.body(0.5, 0, 0, 1, 1.0 / 12);
  m.hinge(m.world, rod, 0, 0);
  m.scene.effects = {Gravity{Vec3(0, -9.81, 0)},
                     BodyDistance{{{m.world, rod}}, {{Vec3(1, 1, 0), Vec3(0.5, 0, 0)}}, {0.5}, {1e-2}}};
  const Scene held = m.finished();
  const Trajectory found = solved_motion(held, {0.3, 1});
  REQUIRE(found.energy_drift);
  CHECK(*found.energy_drift <= 1e-11);
  CHECK((found.samples[0].x - held.initial.x).norm() > 0.1);
  Scene driven = held;
  driven.effects.emplace_back(ExternalTorque{{rod}, {Vec3(0, 0, 1)}});
  CHECK_FALSE(solved_motion(driven, {0.1}).energy_drift);
  driven = held;
  driven.effects.emplace_back(
      AngleJoint{{{m.world, rod}}, {Vec3::UnitZ()}, {{Vec3::UnitX(), Vec3::UnitX()}}, {0}, {0.3}, {1e-3}});
  CHECK_FALSE(solved_motion(driven, {0.1}).energy_drift);
  driven = held;
  driven.initial.spin(2, 0) = 1;
  CHECK_FALSE(solved_motion(driven, {0.1}).energy_drift);  // the spring's support turns
}

TEST_CASE("a hard motor's motion is that of its angle") {
  Scene scene;
  const int world = add_world(scene);
  const double rate = 2, time = 0.7;
  const int arm = add_body(scene, Vec3(0.5, 0, 0), 1, Vec3(0.1, 0.2, 0.25), Eigen::Quaterniond::Identity(),
                           Vec3(0, 0.5 * rate, 0), Vec3(0, 0, rate));
  PointJoint ball;
  join(ball, world, arm, Vec3::Zero(), Vec3(-0.5, 0, 0));
  scene.effects = {
      Gravity{}, Gyroscopic{}, ball, AxisJoint{{{world, arm}}, {{Vec3::UnitZ(), Vec3::UnitZ()}}, {0}},
      AngleJoint{{{world, arm}}, {Vec3::UnitZ()}, {{Vec3::UnitX(), Vec3::UnitX()}}, {0}, {rate}, {0}}};
  const State end = solved_motion(scene, {time}).samples[0];
  CHECK((end.x.col(1) - 0.5 * Vec3(std::cos(rate * time), std::sin(rate * time), 0)).norm() <= 1e-11);
}

TEST_CASE("motions of joints that cannot be trusted are refused") {
  Scene off = rod_chain(2);
  off.initial.x(0, 2) += 1e-6;
  CHECK_THROWS_AS(ode(off, {1}), SetupError);
  Scene late = rod_chain(2);
  late.initial.v(0, 2) += 1e-6;
  CHECK_THROWS_AS(ode(late, {1}), SetupError);
  // Past the place where all its rods are in line a linkage's motion is not determined.
  const Trajectory through = ode(four_bars(1), {0.2, 2}, {1e-13, 20000});
  CHECK(through.outcome == Outcome::not_converged);
  CHECK(through.samples.empty());
}
