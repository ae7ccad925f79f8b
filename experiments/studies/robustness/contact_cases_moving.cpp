// Scenes that slide, roll, swing and spin.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <fmt/format.h>

#include "studies/robustness/contact_cases.h"

namespace pbdcheck {
namespace {

using namespace pbd;

using std::numbers::pi;

/// `friction` just above the tangent of the angle, 0.499999, and below (li2020incremental).
ContactCase on_incline(double friction, bool holds) {
  constexpr double angle = 26.565 * pi / 180;
  ContactCase made{fmt::format("box on 26.565 degrees, mu = {}", friction), sliding_box(angle, friction, 0),
                   0.025, 2, 0.1};
  made.settles = made.stays = holds;
  if (!holds)
    made.missed = [friction, start = made.scene.initial](const State& end, double h, std::int64_t steps) {
      const double a = gravity * (std::sin(angle) - friction * std::cos(angle));
      const double exact = h * h * a * static_cast<double>(steps * (steps + 1)) / 2;  // implicit Euler's
      return std::abs((end.x.col(1) - start.x.col(1)).norm() / exact - 1);
    };
  return made;
}

/// A cube that slides in and must not jump; with much friction it tumbles.
ContactCase rough_cube(double friction) {
  ContactCase made{fmt::format("cube sliding in at 6 m/s, mu = {:g}", friction),
                   sliding_box(0, friction, 6, 0, Vec3::Constant(0.1)), 0.005, 2, 0.1};
  made.settles = friction >= 0.5;
  if (friction <= 0.5) made.lift = 1e-9;
  return made;
}

/// A ball of `ratio` kg at the end of a chain of `links` links swings into a column of cubes.
ContactCase wrecking_ball(int links, double ratio) {
  BodyScene build({.friction = 0.5});
  build.ground();
  for (int k = 0; k < 5; ++k) build.box(Vec3::Constant(0.5), 1, {Vec3(0, 0, 0.25 + 0.5 * k)});
  PointJoint joints;
  const double top = 1.25 + links * 0.5, length = 0.5;
  const int world = build.fixed(Sphere{0.01}, {Vec3(-0.6, 0, top)});
  int last = world;
  for (int k = 0; k < links; ++k) {
    const double x = -0.6 - (k + 0.5) * length;
    const bool ball = k + 1 == links;
    const int link = ball ? build.ball(0.3, ratio, {Vec3(x, 0, top)})
                          : build.box(Vec3(0.45, 0.05, 0.05), 1, {Vec3(x, 0, top)});
    joints.body.push_back({last, link});
    joints.point.push_back({last == world ? Vec3(0, 0, 0) : Vec3(-length / 2, 0, 0), Vec3(length / 2, 0, 0)});
    joints.compliance.push_back(0);
    last = link;
  }
  Scene scene = build.finish();
  scene.effects.emplace_back(std::move(joints));
  ContactCase made{fmt::format("wrecking ball of {:g}:1 on {} links", ratio, links), std::move(scene),
                   video_frame, 3, 0.05};
  made.settles = false;
  return made;
}

ContactCase colliding_balls(int side) {
  BodyScene build({.friction = 0});
  build.ground();
  std::mt19937_64 engine(42);
  std::uniform_real_distribution<double> disturbed(0, 1e-3);
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      for (int k = 0; k < side; ++k) {
        const double x = disturbed(engine), y = disturbed(engine), z = disturbed(engine);
        build.ball(0.1, 10, {Vec3(0.21 * i + x, 0.21 * j + y, 0.101 + 0.21 * k + z)});
      }
  ContactCase made{fmt::format("{0} x {0} x {0} balls", side), build.finish(), 0.01, 2, 0.1};
  made.settles = false;  // without friction they roll away for ever
  return made;
}

/// A coin that rolls on its rim in ever lower circles (Euler's disc).
ContactCase coin() {
  BodyScene build({.friction = 0.5});
  build.ground();
  constexpr double radius = 0.1, thickness = 0.01, tilt = 0.3;
  const double height = radius * std::sin(tilt) + thickness / 2 * std::cos(tilt);
  build.cylinder(
      radius, thickness, 0.5,
      {Vec3(0, 0, height), about_y(tilt), Vec3::Zero(), Vec3(-4 * std::sin(tilt), 0, 4 * std::cos(tilt))});
  ContactCase made{"coin on its rim", build.finish(), 0.002, 3, radius};
  made.settles = false;
  return made;
}

/// A box on a disc that turns at 2 rad/s, 0.5 m from its axis: it sticks if mu > 0.204.
ContactCase turntable(double friction) {
  BodyScene build({.friction = friction});
  const Placing turning{Vec3(0, 0, -0.05), Eigen::Quaterniond::Identity(), Vec3::Zero(), Vec3(0, 0, 2)};
  build.fixed(Cylinder{2, 0.1}, turning);
  build.box(Vec3(0.2, 0.2, 0.1), 1,
            {Vec3(0.5, 0, 0.05), Eigen::Quaterniond::Identity(), Vec3(0, 1, 0), Vec3(0, 0, 2)});
  ContactCase made{fmt::format("box on a turntable, mu = {:g}", friction), build.finish(), 0.005, 2, 0.1};
  made.settles = false;
  made.missed = [friction](const State& end, double h, std::int64_t steps) {
    const double from_axis = end.x.col(1).head<2>().norm();
    if (friction < 0.2) return from_axis > 0.5 ? 0.0 : 1.0;  // it slides outward; sticking it would not
    // Where it sticks implicit Euler turns it by x' = x + h w x x', which shortens x.
    const double exact = 0.5 * std::pow(1 + 4 * h * h, -0.5 * static_cast<double>(steps));
    return std::abs(from_axis / exact - 1);
  };
  return made;
}

/// A box on a belt, held by a spring. It goes with the belt until the spring pulls by mu m g, and swings
/// about that place from then on, ever less by implicit Euler.
ContactCase held_by_spring(double speed) {
  constexpr double friction = 0.35, mass = 1, stiffness = 100;  // N/m
  BodyScene build({.friction = friction});
  build.ground();
  build.contact().collider.back().surface_velocity = Vec3(speed, 0, 0);
  const Vec3 start(0, 0, 0.05);
  const int box =
      build.box(Vec3(0.2, 0.2, 0.1), mass, {start, Eigen::Quaterniond::Identity(), Vec3(speed, 0, 0)});
  const int world = build.fixed(Sphere{0.01}, {Vec3(0, 0, 1)});
  Scene scene = build.finish();
  scene.effects.emplace_back(
      PointJoint{{{world, box}}, {{Vec3(0, 0, start.z() - 1), Vec3::Zero()}}, {1 / stiffness}});
  ContactCase made{fmt::format("box held by a spring on a belt at {:g} m/s", speed), std::move(scene), 0.005,
                   2, 0.1};
  made.settles = false;
  // Implicit Euler in one dimension, the friction within mu m g: with the belt if that can be.
  made.missed = [=](const State& end, double step, std::int64_t steps) {
    double x = 0, v = speed;
    const double most = friction * mass * gravity, m = mass + step * step * stiffness;
    for (std::int64_t k = 0; k < steps; ++k) {
      const double free = mass * v - step * stiffness * x;
      v = std::clamp(speed, (free - step * most) / m, (free + step * most) / m);
      x += step * v;
    }
    return std::abs(end.x(0, box) - x) * stiffness / most;
  };
  return made;
}

}  // namespace

std::vector<ContactCase> moving_cases(bool full) {
  std::vector<ContactCase> all;
  all.push_back(on_incline(0.5, true));
  all.push_back(on_incline(0.49, false));
  for (const double friction : {0.0, 1e-6, 0.5, 1.0, 5.0, 10.0, 1e6}) all.push_back(rough_cube(friction));
  for (const int links : {3, 5, 10})
    if (full || links == 3) all.push_back(wrecking_ball(links, 100));
  all.push_back(colliding_balls(full ? 6 : 3));
  if (full) all.push_back(coin());
  for (const double friction : {0.1, 0.5, 1.0}) all.push_back(turntable(friction));
  for (const double speed : {0.02, 0.1, 0.5})
    if (full || speed == 0.1) all.push_back(held_by_spring(speed));
  return all;
}

}  // namespace pbdcheck
