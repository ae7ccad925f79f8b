#include "studies/iteration/contact_bodies.h"

#include <cmath>
#include <numbers>

#include "scenes/contacts.h"

namespace pbdcheck {
namespace {

using namespace pbd;

Eigen::Quaterniond turned(double angle, const Vec3& axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized()));
}

Scene without_gyroscopic(const BodyScene& build) {
  Scene scene = build.finish();
  std::erase_if(scene.effects,
                [](const Effect& effect) { return std::holds_alternative<Gyroscopic>(effect); });
  return scene;
}

enum class Start { rest, roll, slide };

/// A ball of 1 kg and 0.1 m on one of 0.3 m that is fixed, `push` (N) towards it besides its weight.
template <Start start, int push>
Scene ball_on_ball() {
  constexpr double radius = 0.1, below = 0.3, tilt = 0.3, speed = 0.5;
  BodyScene build({.friction = start == Start::slide ? 0.2 : 0.9});
  build.fixed(Sphere{below}, {Vec3::Zero()});
  const Vec3 normal(std::sin(tilt), 0, std::cos(tilt)), downhill(std::cos(tilt), 0, -std::sin(tilt));
  const Vec3 velocity =
      start == Start::rest ? Vec3(Vec3::Zero()) : Vec3(speed * (0.8 * downhill + 0.6 * Vec3::UnitY()));
  const Vec3 spin = start == Start::roll ? Vec3(normal.cross(velocity) / radius) : Vec3(Vec3::Zero());
  build.ball(radius, 1, {(below + radius) * normal, Eigen::Quaterniond::Identity(), velocity, spin});
  Scene scene = without_gyroscopic(build);
  if (push > 0) scene.effects.emplace_back(ExternalForce{{1}, {-push * normal}});
  return scene;
}

/// A ball of 1 kg and 0.1 m on a rope of 0.5 m leans against a wall and swings along it.
template <Start start>
Scene ball_on_rope() {
  constexpr double radius = 0.1, rope = 0.5;
  BodyScene build({.friction = start == Start::slide ? 0.2 : 0.9});
  build.fixed(HalfSpace{}, {Vec3::Zero(), turned(std::numbers::pi / 2, Vec3::UnitY())});
  build.fixed({}, {Vec3(-0.1, 0, 0.6)});
  const Vec3 across(0.2, 0.1, 0);
  const Vec3 hangs(across.x(), across.y(), -std::sqrt(rope * rope - across.squaredNorm()));
  const double rate = start == Start::slide ? 2 : 0.05;  // rad/s, about the wall's normal
  build.ball(radius, 1,
             {Vec3(-0.1, 0, 0.6) + hangs, Eigen::Quaterniond::Identity(), rate * Vec3::UnitX().cross(hangs)});
  Scene scene = without_gyroscopic(build);
  scene.effects.emplace_back(BodyDistance{{{1, 2}}, {{Vec3::Zero(), Vec3::Zero()}}, {rope}, {0}});
  return scene;
}

/// A cube of 0.2 m and 8 kg tumbles on one corner.
template <Start start>
Scene cube_on_corner() {
  const Vec3 corner = Vec3::Constant(-0.1);
  const Eigen::Quaterniond at =
      turned(0.2, Vec3(1, 2, 0)) * Eigen::Quaterniond::FromTwoVectors(corner, -Vec3::UnitZ());
  const Vec3 lever = at * corner, rate(0.5, -0.3, 0.2);
  const Vec3 slip = start == Start::slide ? Vec3(0.4, 0.3, 0) : Vec3(Vec3::Zero());
  BodyScene build({.friction = start == Start::slide ? 0.1 : 0.9});
  build.ground();
  build.box(Vec3::Constant(0.2), 8,
            {Vec3(0, 0, -lever.z()), at, slip - rate.cross(lever), at.conjugate() * rate});
  return without_gyroscopic(build);
}

/// A cube that tumbles over one of its edges as it slides and yaws.
Scene cube_on_edge() {
  const Eigen::Quaterniond at = turned(0.5, Vec3::UnitY());
  const Vec3 lever = at * Vec3(0.1, 0, -0.1), rate(0, 0.4, 1);
  BodyScene build({.friction = 0.2});
  build.ground();
  build.box(Vec3::Constant(0.2), 8,
            {Vec3(0, 0, -lever.z()), at, Vec3(0.5, 0, 0) - Vec3(0, rate.y(), 0).cross(lever),
             at.conjugate() * rate});
  return without_gyroscopic(build);
}

/// A ball on a ball on the ground, let go or slipping off.
template <Start start>
Scene ball_on_free_ball() {
  constexpr double tilt = 0.4;
  BodyScene build({.friction = start == Start::slide ? 0.1 : 0.9});
  build.ground();
  build.ball(0.2, 2, {Vec3(0, 0, 0.2)});
  const Vec3 normal(std::sin(tilt), 0, std::cos(tilt));
  const Vec3 velocity =
      start == Start::slide ? Vec3(0.3 * std::cos(tilt), 0.3, -0.3 * std::sin(tilt)) : Vec3(Vec3::Zero());
  build.ball(0.1, 1, {Vec3(0, 0, 0.2) + 0.3 * normal, Eigen::Quaterniond::Identity(), velocity});
  return without_gyroscopic(build);
}

}  // namespace

std::vector<TouchingBody> touching_bodies() {
  return {{"ball at rest on a ball", ball_on_ball<Start::rest, 0>},
          {"ball rolls on a ball", ball_on_ball<Start::roll, 0>},
          {"pressed ball rolls on a ball", ball_on_ball<Start::roll, 500>},
          {"ball slides on a ball", ball_on_ball<Start::slide, 0>},
          {"pressed ball slides on a ball", ball_on_ball<Start::slide, 500>},
          {"ball on a rope is stopped by a wall", ball_on_rope<Start::rest>},
          {"ball on a rope slides along a wall", ball_on_rope<Start::slide>},
          {"cube tumbles on a corner", cube_on_corner<Start::roll>},
          {"cube slides on a corner", cube_on_corner<Start::slide>},
          {"cube slides on an edge", cube_on_edge},
          {"ball at rest on a free ball", ball_on_free_ball<Start::rest>},
          {"ball slides on a free ball", ball_on_free_ball<Start::slide>}};
}

}  // namespace pbdcheck
