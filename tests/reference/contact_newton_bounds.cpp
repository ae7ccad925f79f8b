// Steps with limits of joints and motors of limited force, by hand, without contact and with it.
#include <catch2/catch.hpp>
#include <cmath>

#include "cone_ipopt.h"
#include "judged_contact.h"

using namespace pbd;
using namespace pbd::reference;
using namespace pbd::test;
using pbdcheck::BodyScene;

namespace {

/// A wheel of 0.5 kg m^2 about the world's z, turning at `spin` (rad/s), with angle joints of `bounds` and
/// `rest` (rad) that go on at `rate` (rad/s).
Scene limited_wheel(double spin, const std::vector<std::array<double, 2>>& rest_and_rate,
                    const std::vector<ForceBounds>& bounds, double compliance = 0) {
  Scene scene;
  const int world = add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
  const int turning = add_body(scene, Vec3::Zero(), 2, Vec3(1, 1, 0.5), Eigen::Quaterniond::Identity(),
                               Vec3::Zero(), spin * Vec3::UnitZ());
  PointJoint point{{{world, turning}}, {{Vec3::Zero(), Vec3::Zero()}}, {0}};
  AxisJoint axis{{{world, turning}}, {{Vec3::UnitZ(), Vec3::UnitZ()}}, {0}};
  AngleJoint angle;
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    angle.body.push_back({world, turning});
    angle.axis.push_back(Vec3::UnitZ());
    angle.reference.push_back({Vec3::UnitX(), Vec3::UnitX()});
    angle.rest_angle.push_back(rest_and_rate[i][0]);
    angle.rate.push_back(rest_and_rate[i][1]);
    angle.compliance.push_back(compliance);
    angle.bounds.push_back(bounds[i]);
  }
  scene.effects = {point, axis, angle};
  return scene;
}

/// A box of 4 kg on the ground, its middle led along x by a motor of limited force (N) at `rate` (m/s).
Scene driven_box(double force, double rate, double friction) {
  BodyScene build({.friction = friction}, gravity);
  build.ground();
  const int box = build.box(Vec3(0.4, 0.4, 0.1), 4, {.position = {0, 0, 0.05}});
  Scene scene = build.finish();
  const int world = add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
  SlideJoint motor{{{world, box}}, {{Vec3(0, 0, 0.05), Vec3::Zero()}}, {Vec3::UnitX()}, {0}, {rate}, {0}};
  motor.bounds.push_back({-force, force});
  scene.effects.emplace_back(motor);
  return scene;
}

}  // namespace

TEST_CASE("a motor of limited torque turns a wheel by its torque and no faster than its rate") {
  const double torque = 10, inertia = 0.5;
  CHECK(std::abs(judged(limited_wheel(0, {{0, 5}}, {{-torque, torque}})).spin(2, 1) -
                 torque * judged_step_s / inertia) <= by_hand);
  CHECK(std::abs(judged(limited_wheel(0, {{0, -5}}, {{-torque, torque}})).spin(2, 1) +
                 torque * judged_step_s / inertia) <= by_hand);
  CHECK(std::abs(judged(limited_wheel(0, {{0, 0.1}}, {{-torque, torque}})).spin(2, 1) - 0.1) <= by_hand);
  CHECK(std::abs(
            judged(limited_wheel(0, {{0, 5}}, {{-torque, torque}}), Friction::cone, cone_ipopt).spin(2, 1) -
            torque * judged_step_s / inertia) <= 1e-8);
}

TEST_CASE("limits of an angle end a turn there and let it go elsewhere") {
  const std::vector<ForceBounds> limits{{0, infinity}, {-infinity, 0}};
  const std::vector<std::array<double, 2>> at{{-0.02, 0}, {0.03, 0}};
  CHECK(std::abs(judged(limited_wheel(-5, at, limits)).spin(2, 1) + 0.02 / judged_step_s) <= by_hand);
  CHECK(std::abs(judged(limited_wheel(5, at, limits)).spin(2, 1) - 0.03 / judged_step_s) <= by_hand);
  CHECK(std::abs(judged(limited_wheel(1, at, limits)).spin(2, 1) - 1) <= by_hand);
  // One that gives way: I (w - w0) = h gamma, h w + 0.02 + A gamma = 0.
  const double compliance = 1e-3, inertia = 0.5;
  const double soft = (inertia * -5 - judged_step_s * 0.02 / compliance) /
                      (inertia + judged_step_s * judged_step_s / compliance);
  CHECK(std::abs(judged(limited_wheel(-5, at, limits, compliance)).spin(2, 1) - soft) <= by_hand);
}

TEST_CASE("a limited motor drags a box against friction or is held by it") {
  for (const Friction law : {Friction::coulomb, Friction::cone}) {
    CHECK(std::abs(judged(driven_box(10, 1, 0.5), law).v(0, 1)) <= by_hand);  // mu m g is 19.6 N
    CHECK(std::abs(judged(driven_box(100, 0.1, 0.5), law).v(0, 1) - 0.1) <= 1e-9);
  }
  const double force = 30, mass = 4;
  CHECK(std::abs(judged(driven_box(force, 1, 0.5)).v(0, 1) -
                 (force / mass - 0.5 * gravity) * judged_step_s) <= by_hand);
}
