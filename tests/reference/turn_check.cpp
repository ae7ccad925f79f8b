// Turns that the value of a joint does not tell are refuted.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "claimed_step.h"

using namespace pbd;
using namespace pbd::test;

TEST_CASE("turns: a hinge does not turn over, and a motor goes no other way round") {
  constexpr double pi = std::numbers::pi;
  const auto hinged = [](const Vec3& turn, double rate) {
    Scene scene;
    add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
    add_body(scene, Vec3::Zero(), 1, Vec3::Constant(0.1));
    scene.effects.emplace_back(AxisJoint{{{0, 1}}, {{Vec3::UnitZ(), Vec3::UnitZ()}}, {0}});
    if (rate != 0)
      scene.effects.emplace_back(
          AngleJoint{{{0, 1}}, {Vec3::UnitZ()}, {{Vec3::UnitX(), Vec3::UnitX()}}, {0}, {rate}, {0}});
    Step step(scene);
    step.end.spin.col(1) = turn / Step::h;
    step.move();
    step.forces[0] = {0, 0};
    if (rate != 0) step.forces[1] = {0};
    return refuted(step).count("turns");
  };
  CHECK(hinged(Vec3(0, 0, 2), 0) == 0);
  CHECK(hinged(Vec3(pi, 0, 0), 0) == 1);
  CHECK(hinged(Vec3(0, 0, 3), 3 / Step::h) == 0);
  CHECK(hinged(Vec3(0, 0, 3.2), 3.2 / Step::h) == 0);
  CHECK(hinged(Vec3(0, 0, 3.2 - 2 * pi), 3.2 / Step::h) == 1);
}

TEST_CASE("turns: past half a turn from a stop at one side alone") {
  const auto turns = [](double from, double turn, ForceBounds bounds) {
    Scene scene;
    add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
    add_body(scene, Vec3::Zero(), 1, Vec3::Constant(0.1),
             Eigen::Quaterniond(Eigen::AngleAxisd(from, Vec3::UnitZ())));
    scene.effects.emplace_back(
        AngleJoint{{{0, 1}}, {Vec3::UnitZ()}, {{Vec3::UnitX(), Vec3::UnitX()}}, {0}, {0}, {0}, {}, {bounds}});
    Step step(scene);
    step.end.spin.col(1).z() = turn / Step::h;
    step.move();
    step.forces[0] = {0};
    return refuted(step).count("turns");
  };
  CHECK(turns(3, 0.1, {0, infinity}) == 0);
  CHECK(turns(3, 0.2, {0, infinity}) == 1);
  CHECK(turns(-3, -0.1, {-infinity, 0}) == 0);
  CHECK(turns(-3, -0.2, {-infinity, 0}) == 1);
  CHECK(turns(3, 0.2, {-infinity, infinity}) == 0);
}

// As in tests/solver/turns.cpp, within the first of the 64 places that the judge looks at: it must look
// between.
TEST_CASE("turns: about an axis that a reference passes near") {
  constexpr double turn = 4.5, slope = std::numbers::pi / 4, apart = 4.5 / 64;  // rad
  const double height = std::sin(slope) * std::cos(slope) * apart * apart / 8;
  const Vec3 w(std::sin(slope - height / 2), 0, std::cos(slope - height / 2));
  const Vec3 middle(-std::sin(height / 2), 0, std::cos(height / 2));
  const auto begin =
      Eigen::Quaterniond::FromTwoVectors(Vec3::UnitX(), Eigen::AngleAxisd(-apart / 2, w) * middle);
  Scene scene;
  add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
  add_body(scene, Vec3::Zero(), 1, Vec3::Constant(0.1), begin);
  scene.effects.emplace_back(
      AngleJoint{{{0, 1}}, {Vec3::UnitZ()}, {{Vec3::UnitX(), Vec3::UnitX()}}, {0}, {0}, {1e9}});
  Step step(scene);
  step.end.spin.col(1) = turn / Step::h * (begin.conjugate() * w);
  step.move();
  step.forces[0] = {0};
  CHECK(refuted(step).count("turns") == 1);
}

TEST_CASE("turns: no lock, hard or soft, and no stop by a whole turn") {
  constexpr double pi = std::numbers::pi;
  const auto turns = [](double turn, double compliance, ForceBounds bounds) {
    Scene scene;
    add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
    add_body(scene, Vec3::Zero(), 1, Vec3::Constant(0.1));
    scene.effects.emplace_back(AngleJoint{
        {{0, 1}}, {Vec3::UnitZ()}, {{Vec3::UnitX(), Vec3::UnitX()}}, {0}, {0}, {compliance}, {}, {bounds}});
    Step step(scene);
    step.end.spin.col(1).z() = turn / Step::h;
    step.move();
    step.forces[0] = {0};
    return refuted(step).count("turns");
  };
  for (const double compliance : {0.0, 1e-12})
    for (const ForceBounds bounds : {ForceBounds{-infinity, infinity}, ForceBounds{0, infinity}}) {
      CHECK(turns(3, compliance, bounds) == 0);
      CHECK(turns(2 * pi, compliance, bounds) == 1);
      CHECK(turns(-100 * pi, compliance, bounds) == 1);
    }
}
