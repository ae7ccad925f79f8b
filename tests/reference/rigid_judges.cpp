// Steps of rigid bodies with a closed form, and agreement of the judges where there is none.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "body_scenes.h"
#include "every_joint.h"
#include "nonlinear.h"
#include "numerics.h"
#include "primal_newton.h"
#include "rigid_model.h"
#include "scenes/mechanisms.h"

using namespace pbd;
using namespace pbd::reference;
using namespace pbd::test;
using pbdcheck::andrews_squeezer;
using pbdcheck::four_bars;

namespace {

/// Uniform rod of 1 m on a hinge along y through the origin, at an angle from the lowest point.
Scene hinged_rod(double angle, double rate) {
  Scene scene;
  const int world = add_world(scene);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(std::numbers::pi / 2 - angle, Vec3::UnitY()));
  const Vec3 half(0.5, 0, 0), x = turn * half;
  const Vec3 w(0, -rate, 0);
  const int rod = add_body(scene, x, 2, 2.0 / 12 * Vec3(0.01, 1, 1), turn, w.cross(x), w);
  PointJoint ball;
  join(ball, world, rod, Vec3::Zero(), -half);
  scene.effects = {Gravity{}, Gyroscopic{}, ball,
                   AxisJoint{{{world, rod}}, {{Vec3::UnitY(), Vec3::UnitY()}}, {0}}};
  return scene;
}

}  // namespace

TEST_CASE("one step of a free body fulfils Euler's discrete equation, by each kind of gyroscopic torque") {
  const Vec3 inertia(1, 2, 3), spin(1, -2, 0.7), torque(0.3, 0.2, -0.4), velocity(1, 2, 3);
  const double h = 0.05;
  for (const int kind : {0, 1, 2}) {
    Scene scene;
    add_body(scene, Vec3::Zero(), 2, inertia, turn_a, velocity, spin);
    scene.effects = {ExternalTorque{{0}, {torque}}};
    if (kind > 0) scene.effects.emplace_back(Gyroscopic{kind == 2});
    for (const NamedJudge& named : judges()) {
      const Judgement j = named.judge(scene, scene.initial, h);
      INFO(named.name << " " << kind << " " << j.reason);
      REQUIRE(j.outcome == Outcome::ok);
      const Vec3 w = j.spin.col(0), at = kind == 2 ? w : spin;
      Vec3 expected = turn_a.toRotationMatrix().transpose() * torque;
      if (kind > 0) expected -= at.cross(inertia.cwiseProduct(at));
      CHECK((inertia.cwiseProduct(w - spin) / h - expected).norm() <= 1e-11);
      const Eigen::Matrix3d turned =
          turn_a.toRotationMatrix() * Eigen::AngleAxisd(h * w.norm(), w.normalized()).toRotationMatrix();
      CHECK((j.orientation[0].toRotationMatrix() - turned).norm() <= 1e-12);
      CHECK((j.x.col(0) - h * velocity).norm() <= 1e-13);
    }
    CHECK(primal_newton(scene, scene.initial, h).certified);
  }
}

TEST_CASE("one step of a hinged rod is the root of its equation in one angle") {
  const double h = 0.05, mass = 2, start = 1.1, rate = 2;
  const Scene scene = hinged_rod(start, rate);
  // x = d (sin a, -cos a): the force F = m ((x1 - x0)/h - v_l)/h - m g at the hinge turns the rod about its
  // centre, I (w - w_l)/h = torque of F at -x1.
  const auto place = [](double angle) {
    return Eigen::Vector2d(0.5 * std::sin(angle), -0.5 * std::cos(angle));
  };
  const Eigen::Vector2d before = 0.5 * rate * Eigen::Vector2d(std::cos(start), std::sin(start));
  const auto equation = [&](double w) {
    const Eigen::Vector2d x = place(start + h * w), v = (x - place(start)) / h;
    const Eigen::Vector2d force = mass * ((v - before) / h + Eigen::Vector2d(0, 9.81));
    const double torque = -(x[0] * force[1] - x[1] * force[0]);
    return mass / 12 * (w - rate) / h - torque;
  };
  const double w = find_root(equation, rate - 5, rate + 2);
  for (const NamedJudge& named : judges()) {
    const Judgement j = named.judge(scene, scene.initial, h);
    INFO(named.name << " " << j.reason);
    REQUIRE(j.outcome == Outcome::ok);
    CHECK((j.spin.col(1) - Vec3(0, -w, 0)).norm() <= 1e-11);
    const Eigen::Vector2d x = place(start + h * w);
    CHECK((j.x.col(1) - Vec3(x[0], 0, x[1])).norm() <= 1e-12);
  }
}

TEST_CASE("a rod balanced upright is certified for steps that are short to its fall") {
  // Turned by d: I d/h^2 - m g l/2 sin(d), I = m l^2/3: regular for all h but sqrt(2 l/(3 g)), stable below.
  const Scene scene = hinged_rod(std::numbers::pi, 0);
  const double limit = std::sqrt(2 / (3 * 9.81));
  CHECK(primal_newton(scene, scene.initial, 0.9 * limit).certified);
  const Judgement longer = primal_newton(scene, scene.initial, 1.1 * limit);
  CHECK_FALSE(longer.certified);
  CHECK_THAT(longer.note, Catch::Contains("regularity not shown"));
}

TEST_CASE("a compliant joint acts as the spring it is, a motor turns at its rate") {
  const double h = 0.02, mass = 2, compliance = 1e-3;
  Scene scene;
  const int world = add_world(scene), body = add_body(scene, Vec3(0.1, 0.2, 0.3), mass, Vec3(1, 1, 1));
  PointJoint soft;
  join(soft, world, body, Vec3::Zero(), Vec3::Zero(), compliance);
  scene.effects = {Gravity{}, soft};
  const Vec3 free = scene.initial.x.col(1) + h * h * Vec3(0, 0, -9.81);
  const double inertia = mass / (h * h);
  for (const NamedJudge& named : judges())
    CHECK((named.judge(scene, scene.initial, h).x.col(1) - inertia / (inertia + 1 / compliance) * free)
              .norm() <= 1e-13);

  scene = hinged_rod(0.5, 0);
  scene.initial.time = 4;
  const Vec3 down = -Vec3::UnitZ(), own = Vec3::UnitX();
  scene.effects.emplace_back(AngleJoint{{{0, 1}}, {Vec3::UnitY()}, {{down, own}}, {1.5}, {-0.5}, {0}});
  for (const NamedJudge& named : judges()) {
    const Judgement j = named.judge(scene, scene.initial, h);
    // Turned about y by 1.5 - 0.5 t from straight down.
    const double angle = 1.5 - 0.5 * (4 + h);
    CHECK((j.x.col(1) - 0.5 * Vec3(-std::sin(angle), 0, -std::cos(angle))).norm() <= 1e-12);
  }
}

TEST_CASE("bodies of infinite mass or inertia keep their velocities") {
  Scene scene;
  add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity), turn_a, Vec3(1, 0, 2), Vec3(0, 3, 1));
  add_body(scene, Vec3::UnitX(), 2, Vec3::Constant(infinity), turn_b, Vec3(0, 1, 0), Vec3(2, 0, 1));
  PointJoint ball;
  join(ball, 0, 1, turn_a.conjugate() * Vec3::UnitX(), Vec3::Zero());
  scene.effects = {Gravity{}, ball};
  const double h = 0.1;
  for (const NamedJudge& named : judges()) {
    const Judgement j = named.judge(scene, scene.initial, h);
    INFO(named.name << " " << j.reason);
    REQUIRE(j.outcome == Outcome::ok);
    CHECK(j.spin == scene.initial.spin);
    CHECK((j.x.col(0) - h * Vec3(1, 0, 2)).norm() <= 1e-15);
    const Eigen::Quaterniond turned = turned_by(turn_a, h * Vec3(0, 3, 1));
    CHECK((j.x.col(1) - j.x.col(0) - turned * (turn_a.conjugate() * Vec3::UnitX())).norm() <= 1e-12);
  }
}

TEST_CASE("redundant joints are found and share the multipliers of single ones") {
  const double h = 1.0 / 60;
  Scene scene = rod_chain(3);
  const Judgement single = primal_newton(scene, scene.initial, h);
  CHECK(single.rank == 9);
  scene.effects.push_back(scene.effects[2]);
  const Judgement doubled = primal_newton(scene, scene.initial, h);
  INFO(doubled.reason);
  REQUIRE(doubled.outcome == Outcome::ok);
  CHECK(doubled.rank == 9);
  CHECK(doubled.certified);
  CHECK(doubled.note.find("redundant") != std::string::npos);
  CHECK((single.x - doubled.x).cwiseAbs().maxCoeff() <= 1e-14);
  CHECK((doubled.multiplier.head(9) - single.multiplier / 2).norm() <= 1e-9 * single.multiplier.norm());
  CHECK((doubled.multiplier.tail(9) - single.multiplier / 2).norm() <= 1e-9 * single.multiplier.norm());
  // A plane loop: of the five rows of each hinge three in all say what the others do.
  for (const int loops : {1, 3}) {
    const Scene linkage = four_bars(loops);
    const Judgement j = primal_newton(linkage, linkage.initial, h);
    INFO(j.reason << j.note);
    CHECK(j.outcome == Outcome::ok);
    CHECK(j.infeasible <= 1e-12);
    CHECK(j.rank == 6 * (2 * loops + 1) - 1);
  }
}

TEST_CASE("contradictory joints are not passed off as solved") {
  Scene parted = rod_chain(2), twice = parted;
  const Vec3 place = Vec3::UnitX();
  PointJoint other = std::get<PointJoint>(parted.effects[2]);
  other.point[1][1] += Vec3(0, 1e-4, 0);
  parted.effects.emplace_back(other);
  // Two lengths of one distance: of two dependent rows Newton looks at one alone.
  const double length = (place - twice.initial.x.col(2)).norm();
  twice.effects.emplace_back(BodyDistance{
      {{0, 2}, {0, 2}}, {{place, Vec3::Zero()}, {place, Vec3::Zero()}}, {length, 1.001 * length}, {0, 0}});
  for (const Scene& scene : {parted, twice})
    for (const NamedJudge& named : judges()) {
      const Judgement j = named.judge(scene, scene.initial, 1.0 / 60);
      INFO(named.name);
      CHECK(j.outcome != Outcome::ok);
      CHECK_FALSE(j.reason.empty());
    }
  CHECK(primal_newton(twice, twice.initial, 1.0 / 60).outcome == Outcome::infeasible);
}

TEST_CASE("the judges agree on joints, loops, ropes and solids on bodies") {
  Scene doubled = rod_chain(3);
  doubled.effects.push_back(doubled.effects[2]);
  // The squeezer's crank turns once in a few milliseconds: a longer step has several solutions.
  for (const auto& [scene, longest] : {std::pair{rod_chain(1), 1e-2},
                                       {rod_chain(6), 1e-2},
                                       {rod_chain(3, 1e-4), 1e-2},
                                       {doubled, 1e-2},
                                       {every_joint(1e-3), 1e-2},
                                       {body_with_rope_and_solid(), 1e-2},
                                       {four_bars(2), 1e-2},
                                       {andrews_squeezer(), 1e-3}})
    for (const double h : {longest, longest / 10}) {
      const Judgement newton = primal_newton(scene, scene.initial, h);
      const Judgement other = ipopt(scene, scene.initial, h);
      INFO(scene.bodies.size() << " bodies, h " << h << ": " << newton.reason << newton.note << " / "
                               << other.reason);
      REQUIRE(newton.outcome == Outcome::ok);
      REQUIRE(other.outcome == Outcome::ok);
      CHECK(newton.certified);
      CHECK(newton.correction <= 1e-11);
      CHECK(newton.residual <= 1e-11);
      const double moved = (newton.x - scene.initial.x).cwiseAbs().maxCoeff();
      CHECK(newton.infeasible <= 1e-12 + 1e-15 * newton.x.cwiseAbs().maxCoeff() / moved);
      CHECK((newton.x - other.x).cwiseAbs().maxCoeff() <= 1e-9 * moved);
      const double turning = newton.spin.cwiseAbs().maxCoeff();
      CHECK((newton.spin - other.spin).cwiseAbs().maxCoeff() <= 1e-8 * turning);
      for (std::size_t b = 0; b < scene.bodies.size(); ++b)
        CHECK(newton.orientation[b].angularDistance(other.orientation[b]) <= 1e-9);
    }
}
