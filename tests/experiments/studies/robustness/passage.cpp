// What the judge of passages says of planted ways, and that thrown pairs are as they are said to be.
#include "studies/robustness/passage.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "harness/step_checks.h"
#include "step/step.h"
#include "step_check.h"
#include "studies/robustness/thrown_pair.h"
#include "validate.h"

using namespace pbdcheck;
using pbd::Vec3;

namespace {

/// A body of each shape at the origin.
struct Two {
  pbd::Scene scene;
  std::array<Core, 2> core;
  pbd::State from, to;

  Two(const pbd::Shape& a, const pbd::Shape& b) {
    for (const int body : {0, 1}) {
      add_body(scene, Vec3::Zero(), 1, Vec3::Ones());
      core[static_cast<std::size_t>(body)] = core_of({body == 0 ? a : b, body}, core_share);
    }
    from = to = scene.initial;
  }
  bool passes(const Vec3& begin, const Vec3& end) {
    from.x.col(0) = begin;
    to.x.col(0) = end;
    return pass_through(scene, core[0], core[1], from, to);
  }
};

std::string named(const std::array<Thing, 2>& kinds) {
  const auto name = [](Thing kind) { return std::string(thing_names[static_cast<std::size_t>(kind)]); };
  return name(kinds[0]) + ", " + name(kinds[1]);
}

}  // namespace

TEST_CASE("a ball on a straight way passes where the way comes nearer to another one than both cores") {
  Two balls(pbd::Sphere{0.1}, pbd::Sphere{0.2});
  const double reach = core_share * 0.3;
  for (const double share : {0.9, 0.999, 1.001, 1.1})
    CHECK(balls.passes({-50, share * reach, 0}, {50, share * reach, 0}) == (share < 1));
  CHECK_FALSE(balls.passes({-50, 0, 0}, {-reach - 1e-3, 0, 0}));
  CHECK(balls.passes({-50, 0, 0}, {-reach + 1e-3, 0, 0}));
}

TEST_CASE("a ball passes through a thin plate and a mesh, and beside their edges does not") {
  const Vec3 sides(2, 2, 0.01);
  for (const pbd::Shape& plate :
       {pbd::Shape(pbd::Box{sides}), pbd::Shape(pbd::ClosedMesh(pbd::box_surface(sides)))}) {
    Two two(pbd::Sphere{0.1}, plate);
    CHECK(two.passes({0.3, 0.2, 40}, {0.3, 0.2, -60}));
    CHECK_FALSE(two.passes({1.0, 0.2, 40}, {1.0, 0.2, -60}));
    CHECK_FALSE(two.passes({0, 0, 40}, {60, 0, 0.12}));
  }
}

TEST_CASE("a rod that turns in place passes what its way leads through, and no other") {
  // Its end is at 0.9, its core's at 0.81, and sweeps a quarter of a circle.
  Two two(pbd::Capsule{0.01, 1.78}, pbd::Sphere{0.05});
  const auto along = [](double angle) { return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vec3::UnitX())); };
  two.to.orientation[0] = along(std::numbers::pi / 2);  // from z to -y
  const auto at = [&](double angle, double distance) {
    const Vec3 x = distance * Vec3(0, -std::sin(angle), std::cos(angle));
    two.from.x.col(1) = two.to.x.col(1) = x;
    return two.passes(Vec3::Zero(), Vec3::Zero());
  };
  CHECK(at(0.8, 0.8));
  CHECK_FALSE(at(0.8, 0.81 + 0.9 * 0.05 + 1e-3));
  CHECK_FALSE(at(-0.8, 0.8));
}

TEST_CASE("a rod passes where its spin leads it, round by more than half a turn") {
  Two two(pbd::Capsule{0.01, 1.78}, pbd::Sphere{0.05});
  const auto passes = [&](double turn, double angle) {  // from z to -y and on
    two.to.time = two.from.time + 0.1;
    two.to.orientation[0] = Eigen::Quaterniond(Eigen::AngleAxisd(turn, Vec3::UnitX()));
    two.to.spin.col(0) = Vec3(turn / 0.1, 0, 0);
    two.from.x.col(1) = two.to.x.col(1) = 0.8 * Vec3(0, -std::sin(angle), std::cos(angle));
    return two.passes(Vec3::Zero(), Vec3::Zero());
  };
  const double round = 2 * std::numbers::pi;
  CHECK(passes(1.0, 0.8));
  CHECK_FALSE(passes(1.0, 1.6));
  CHECK(passes(1.0 + round, 1.6));
  CHECK(passes(1.0 - round, 1.6));
  CHECK_FALSE(passes(-1.0, 1.6));
}

TEST_CASE("of a cylinder the core is inside, and the whole about it") {
  const pbd::Cylinder cylinder{0.5, 0.2};
  const auto radius = [&](double share) -> double {
    return core_of({cylinder, 0}, share).piece[0].topRows(2).colwise().norm().maxCoeff();
  };
  CHECK(std::abs(radius(core_share) - core_share * 0.5) <= 1e-12);
  CHECK(std::abs(radius(1) - 0.5 / std::cos(std::numbers::pi / 32)) <= 1e-12);
}

TEST_CASE("below a half space is passed, and above it not, whatever the way was") {
  Two two(pbd::Box{{1, 1, 1}}, pbd::HalfSpace{});
  CHECK_FALSE(two.passes({0, 0, 9}, {0, 0, 0.5}));
  CHECK_FALSE(two.passes({0, 0, 9}, {0, 0, 0.451}));
  CHECK(two.passes({0, 0, 9}, {0, 0, 0.449}));
}

TEST_CASE("thrown pairs are valid scenes, begin apart, and are the same each time") {
  for (const auto& kinds : thrown_pairs()) {
    INFO(named(kinds));
    for (int i = 0; i < 3; ++i) {
      const ThrownPair once = thrown_pair(kinds, i, true), again = thrown_pair(kinds, i, true);
      CHECK_NOTHROW(pbd::validate(once.scene));
      CHECK(once.scene.initial.x == again.scene.initial.x);
      CHECK(apart(once.scene, once.whole[0], once.whole[1], once.scene.initial) >= 0.999 * once.apart);
    }
  }
}

TEST_CASE("what is thrown passes through nothing in a solved step, be it in touch before") {
  constexpr std::array<std::array<Thing, 2>, 7> all{{{Thing::box, Thing::box},
                                                     {Thing::hull, Thing::hull},
                                                     {Thing::sphere, Thing::mesh},
                                                     {Thing::point, Thing::mesh},
                                                     {Thing::point, Thing::hull},
                                                     {Thing::point, Thing::half_space},
                                                     {Thing::sphere, Thing::half_space}}};
  int solved = 0;
  for (const auto& kinds : all)
    for (int i = 0; i < 30; ++i) {
      const ThrownPair pair = thrown_pair(kinds, i, true);
      pbd::Workspace workspace(pair.scene, pbd::Method{});
      pbd::State state = pair.scene.initial;
      for (int k = 0; k < pair.steps; ++k) {
        const pbd::State from = state;
        if (step(workspace, pair.h, state).status != pbd::Status::ok) break;
        INFO(named(kinds) << ", scene " << i << ", step " << k);
        CHECK_FALSE(pass_through(pair.scene, pair.core[0], pair.core[1], from, state));
        ++solved;
      }
    }
  CHECK(solved > 150);
}

TEST_CASE("no solved step of what is thrown at each other is refuted") {
  int solved = 0;
  for (const auto& kinds : thrown_pairs())
    for (int i = 0; i < 5; ++i) {
      const ThrownPair pair = thrown_pair(kinds, i, true);
      const pbd::reference::StepCheck check(pair.scene);
      pbd::Workspace workspace(pair.scene, pbd::Method{});
      pbd::State state = pair.scene.initial;
      for (int k = 0; k < pair.steps; ++k) {
        const pbd::State from = state;
        const pbd::Report report = step(workspace, pair.h, state);
        if (report.status != pbd::Status::ok) break;
        const auto found = check.judge(claim_of(pair.scene, workspace, from, state, pair.h, report));
        INFO(named(kinds) << ", scene " << i << ", step " << k);
        for (const auto& finding : found.refuted) FAIL_CHECK(finding.check << ": " << finding.what);
        ++solved;
      }
    }
  CHECK(solved > 400);
}

TEST_CASE("a missed step cuts what begins in touch no deeper into each other than to their cores") {
  constexpr std::array<std::array<Thing, 2>, 4> all{{{Thing::sphere, Thing::sphere},
                                                     {Thing::box, Thing::capsule},
                                                     {Thing::hull, Thing::hull},
                                                     {Thing::box, Thing::static_mesh}}};
  int missed = 0;
  for (const auto& kinds : all)
    for (int i = 0; i < 350; ++i) {
      const ThrownPair pair = thrown_pair(kinds, i, true);
      pbd::Workspace workspace(pair.scene, pbd::Method{});
      pbd::State state = pair.scene.initial;
      if (pair.steps < 2 || step(workspace, pair.h, state).status != pbd::Status::ok) continue;
      if (!(apart(pair.scene, pair.whole[0], pair.whole[1], state) < pair.apart)) continue;
      const pbd::State from = state;
      pbd::Method hurried;  // most steps would be solved
      hurried.max_outer = 1;
      pbd::Workspace second(pair.scene, hurried);
      if (step(second, pair.h, state).status != pbd::Status::not_converged) continue;
      INFO(named(kinds) << ", scene " << i);
      CHECK_FALSE(pass_through(pair.scene, pair.core[0], pair.core[1], from, state));
      ++missed;
    }
  CHECK(missed > 0);  // else nothing has been seen
}
