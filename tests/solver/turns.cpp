// Turns that joints cannot tell from less.
#include <catch2/catch.hpp>
#include <numbers>

#include "body_scenes.h"
#include "step/step.h"

using namespace pbd;
using namespace pbd::test;

namespace {

/// Straight rods of 0.2 m along x, jointed, between two bodies that push their ends together at 1 m/s.
Scene pushed_rods(int rods) {
  Scene scene;
  const Vec3 half(0.1, 0, 0);
  const auto end = [&](double x, double speed) {
    return add_body(scene, Vec3(x, 0, 0), infinity, Vec3::Constant(infinity), Eigen::Quaterniond::Identity(),
                    Vec3(speed, 0, 0));
  };
  PointJoint balls;
  int last = end(0, 0.5);
  Vec3 on_last = Vec3::Zero();
  for (int k = 0; k < rods; ++k) {
    const int rod = add_body(scene, Vec3(0.1 + 0.2 * k, 0, 0), 0.28, Vec3(6e-5, 1e-3, 1e-3));
    join(balls, last, rod, on_last, -half);
    last = rod, on_last = half;
  }
  join(balls, last, end(0.2 * rods, -0.5), on_last, Vec3::Zero());
  scene.effects = {balls, Gravity{}, Gyroscopic{}};
  return scene;
}

}  // namespace

TEST_CASE("no step that says ok has a joint throw a body round") {
  const Scene scene = pushed_rods(13);
  constexpr double h = 0.01;
  const auto turn = [&](const State& state) { return h * state.spin.colwise().norm().maxCoeff(); };
  int thrown = 0;
  for (const auto relaxation : {"direct", "conjugate_gradients"}) {
    Method method;
    method.relaxation = relaxation;
    Workspace workspace(scene, method);
    State state = scene.initial;
    for (int k = 0; k < 30; ++k) {
      const double before = turn(state);
      const Report report = step(workspace, h, state);
      if (report.status == Status::diverged) break;
      if (report.reason.find("half a turn") != std::string::npos) ++thrown;
      if (report.status == Status::ok && before < std::numbers::pi) CHECK(turn(state) <= std::numbers::pi);
    }
  }
  CHECK(thrown > 0);  // else nothing has been seen
}

// A body hinged about z to the world, or held by it whole or at a right angle, spins about x, which each of
// these forbids: at rest is where the step ends. They hold after half a turn over, too.
TEST_CASE("no step that says ok has turned a body over") {
  const double spin = GENERATE(0.5, 1.4, 1.57, 2.0, 2.8, 5.0, 16 * std::numbers::pi, 100.0);  // rad a step
  const int kind = GENERATE(0, 1, 2);
  Scene scene;
  const int world = add_world(scene), body = add_body(scene, Vec3::Zero(), 1, Vec3(1, 2, 3));
  const std::vector<std::array<int, 2>> pair{{world, body}};
  if (kind == 0)
    scene.effects.emplace_back(AxisJoint{pair, {{Vec3::UnitZ(), Vec3::UnitZ()}}, {0}});
  else if (kind == 1)
    scene.effects.emplace_back(PerpendicularJoint{pair, {{Vec3::UnitY(), Vec3::UnitZ()}}, {0}});
  else
    scene.effects.emplace_back(RotationJoint{pair, {Eigen::Quaterniond::Identity()}, {0}});
  scene.initial.spin.col(body) = Vec3(spin, 0, 0);
  Workspace workspace(scene, Method{});
  State state = scene.initial;
  INFO(spin << " rad, joint " << kind);
  const bool ok = step(workspace, 1, state).status == Status::ok;
  if (ok) CHECK(state.spin.norm() < 1e-6);
  if (spin < 1) CHECK(ok);
}

namespace {

/// A body on a hinge, driven at `rate` (rad/s) and as fast.
Scene driven(double rate) {
  Scene scene;
  const int world = add_world(scene);
  const int body = add_body(scene, Vec3(0.3, 0.2, 0.1), 2, Vec3(0.1, 0.2, 0.3),
                            Eigen::Quaterniond::Identity(), Vec3::Zero(), Vec3(0, 0, rate));
  const std::vector<std::array<int, 2>> pair{{world, body}};
  scene.effects = {AxisJoint{pair, {{Vec3::UnitZ(), Vec3::UnitZ()}}, {0}},
                   AngleJoint{pair, {Vec3::UnitZ()}, {{Vec3::UnitX(), Vec3::UnitX()}}, {0}, {rate}, {0}}};
  return scene;
}

}  // namespace

TEST_CASE("a motor by more than half a turn a step is no step that says ok") {
  const double turn = GENERATE(3.1, 3.2, 7.0);  // rad a step
  const bool limited = GENERATE(false, true);
  constexpr double h = 0.01;
  Scene scene = driven(turn / h);
  if (limited) std::get<AngleJoint>(scene.effects[1]).bounds = {{-1e9, 1e9}};
  Workspace workspace(scene, Method{});
  State state = scene.initial;
  const Report report = step(workspace, h, state);
  INFO(turn << " rad: " << report.reason);
  CHECK((report.status == Status::ok) == (turn < std::numbers::pi));
  CHECK((report.reason.find("half a turn") != std::string::npos) == (turn > std::numbers::pi));
}

// A wheel is locked, hard or softly, or has a stop at either side: none may bring it energy, nor let it by.
TEST_CASE("a lock or a stop throws no fast wheel round with ok") {
  constexpr double h = 0.01;
  const double turn = GENERATE(1.0, 3.0, 3.2, 2 * std::numbers::pi, 50.0) * GENERATE(1, -1);  // rad a step
  const int kind = GENERATE(0, 1, 2, 3);
  Scene scene = driven(0);
  auto& angle = std::get<AngleJoint>(scene.effects[1]);
  if (kind == 1) angle.compliance = {1e-12};
  if (kind > 1) angle.bounds = {kind == 2 ? ForceBounds{0, infinity} : ForceBounds{-infinity, 0}};
  scene.initial.spin.col(1).z() = turn / h;
  Workspace workspace(scene, Method{});
  State state = scene.initial;
  const Report report = step(workspace, h, state);
  INFO(turn << " rad, kind " << kind << ": " << report.reason);
  if (report.status == Status::ok) {
    CHECK(state.spin.norm() * h <= std::abs(turn) * (1 + 1e-9));
    CHECK(state.spin.norm() * h <= std::numbers::pi);
  }
  if (std::abs(turn) < std::numbers::pi) CHECK(report.status == Status::ok);
}

// A body turns by 0.9 rad about w, 45 degrees from its reference, which draws an arc. The angle's axis lies
// half way between the arc and the great circle through its ends: from there the arc spans more than pi.
TEST_CASE("what goes round an angle's axis near it by more than half a turn is no step that says ok") {
  constexpr double turn = 0.9, slope = std::numbers::pi / 4, beside = 0.025;  // rad
  const Vec3 w(std::sin(slope - beside), 0, std::cos(slope - beside));
  const double sense = GENERATE(1, -1);
  const Vec3 middle(-std::sin(beside), 0, std::cos(beside));
  const auto begin =
      Eigen::Quaterniond::FromTwoVectors(Vec3::UnitX(), Eigen::AngleAxisd(-sense * turn / 2, w) * middle);
  Scene scene;
  const int world = add_world(scene), body = add_body(scene, Vec3::Zero(), 1, Vec3::Ones(), begin);
  scene.effects.emplace_back(
      AngleJoint{{{world, body}}, {Vec3::UnitZ()}, {{Vec3::UnitX(), Vec3::UnitX()}}, {0}, {0}, {1e9}});
  scene.initial.spin.col(body) = sense * turn * (begin.conjugate() * w);
  Workspace workspace(scene, Method{});
  State state = scene.initial;
  CHECK(step(workspace, 1, state).reason.find("half a turn") != std::string::npos);
}

// It has the stop on its other side there: no step that says ok leads to where the next would throw it back.
TEST_CASE(
    "a wheel that turns away from its only stop goes past half a turn from it in no step that says ok") {
  constexpr double h = 0.01;
  const double turn = GENERATE(0.102, 0.8, 2.5) * GENERATE(1, -1);  // rad a step, half of which ends short
  const double compliance = GENERATE(0.0, 0.1);
  Scene scene = driven(0);
  auto& angle = std::get<AngleJoint>(scene.effects[1]);
  angle.compliance = {compliance};
  angle.bounds = {turn > 0 ? ForceBounds{0, infinity} : ForceBounds{-infinity, 0}};
  scene.initial.spin.col(1).z() = turn / h;
  Method method;
  method.integrator = GENERATE("implicit_euler", "midpoint");
  Workspace workspace(scene, method);
  State state = scene.initial;
  const int last = static_cast<int>(std::numbers::pi / std::abs(turn));
  for (int k = 0; k < last; ++k) CHECK(step(workspace, h, state).status == Status::ok);
  CHECK(state.spin(2, 1) * h == Approx(turn));
  CHECK(step(workspace, h, state).reason.find("half a turn") != std::string::npos);
}

TEST_CASE("a weld that begins open by a right angle is not turned over with ok") {
  const double open = GENERATE(0.3, 1.1, 1.25, 1.5);  // rad
  const double spin = GENERATE(-2.5, 0.0, 2.5);       // rad a step
  Scene scene;
  const int world = add_world(scene);
  const int body = add_body(scene, Vec3::Zero(), 1, Vec3(1, 2, 3),
                            Eigen::Quaterniond(Eigen::AngleAxisd(open, Vec3::UnitX())));
  scene.effects.emplace_back(RotationJoint{{{world, body}}, {Eigen::Quaterniond::Identity()}, {0}});
  scene.initial.spin.col(body) = Vec3(spin, 0, 0);
  Workspace workspace(scene, Method{});
  State state = scene.initial;
  const bool ok = step(workspace, 1, state).status == Status::ok;
  INFO(open << " rad open, " << spin << " rad");
  if (ok) CHECK(state.spin(0, body) == Approx(-open).epsilon(1e-6));
  if (spin == 0) CHECK(ok);
}

TEST_CASE("a motor goes on for a thousand turns: its angle is known to its own rounding") {
  constexpr double h = 0.01, rate = 10;
  Scene scene = driven(rate);
  const double time = GENERATE(6.6, 628.0);
  scene.initial.time = time;
  scene.initial.orientation[1] = Eigen::AngleAxisd(rate * time, Vec3::UnitZ());
  Workspace workspace(scene, Method{});
  State state = scene.initial;
  int missed = 0;
  for (int k = 0; k < 500; ++k) missed += step(workspace, h, state).status != Status::ok;
  CHECK(missed == 0);
  CHECK(state.spin(2, 1) == Approx(rate).epsilon(1e-9));
}

TEST_CASE("a joint that begins open throws no body round, as fast as that turns already") {
  const double spin = GENERATE(-400.0, 700.0), open = GENERATE(0.5, 1.0);  // rad/s, m
  Scene scene;
  const int held = add_body(scene, Vec3(0.1, open, 0), infinity, Vec3::Constant(infinity));
  const int rod = add_body(scene, Vec3::Zero(), 0.28, Vec3(6e-5, 1e-3, 1e-3));
  PointJoint ball;
  join(ball, held, rod, Vec3::Zero(), Vec3(0.1, 0, 0));
  scene.effects = {ball, Gyroscopic{}};
  scene.initial.spin.col(rod) = Vec3(0, 0, spin);
  Method method;
  method.relaxation = "direct";
  Workspace workspace(scene, method);
  State state = scene.initial;
  const Report report = step(workspace, 0.01, state);
  INFO(spin << " rad/s, open by " << open << " m: " << report.reason);
  // By how much the joint changes the spin: within half a turn a step the step is solved.
  CHECK((report.status == Status::ok) == (open < 1));
  CHECK((report.reason.find("half a turn") != std::string::npos) == (open == 1));
}
