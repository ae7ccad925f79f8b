// A ball in a wedge of two plates, which holds it or squeezes it out whatever the force.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "ledger/families.h"
#include "ledger/motion.h"
#include "scenes/contacts.h"
#include "studies/contact/contact_answers.h"

namespace pbdcheck::ledger {
namespace {

using namespace pbd;

constexpr double ball_radius = 0.1;  // m

/// A ball on the ground under a plate that is tilted by `angle` (rad) about y, moves up and down alone and is
/// pressed on it by 10 N; no gravity. The ball is the last body.
Scene wedge(double angle, double friction) {
  BodyScene build({.friction = friction}, 0);
  build.ground();
  const int guide = build.fixed(Sphere{ball_radius}, {Vec3(0, 0, 100 * ball_radius)});
  const Eigen::Quaterniond tilt(Eigen::AngleAxisd(angle, Vec3::UnitY()));
  constexpr double thick = 0.02;
  const Vec3 top = Vec3(0, 0, ball_radius) + tilt * Vec3(0, 0, ball_radius + thick / 2);
  const int plate = build.box(Vec3(0.15, 0.15, thick), 1, {top, tilt});
  build.ball(ball_radius, 1, {Vec3(0, 0, ball_radius)});
  Scene scene = build.finish();
  scene.effects.emplace_back(LineJoint{
      {{guide, plate}}, {{top - Vec3(0, 0, 100 * ball_radius), Vec3::Zero()}}, {Vec3::UnitZ()}, {0}});
  scene.effects.emplace_back(RotationJoint{{{guide, plate}}, {tilt}, {0}});
  scene.effects.emplace_back(
      ExternalForce{{scene.bodies[static_cast<std::size_t>(plate)].node}, {Vec3(0, 0, -10)}});
  return scene;
}

}  // namespace

void jams(Ledger& rows) {
  for (const double degrees : {5.0, 16.6992443, 30.0}) {
    const double half = degrees * std::numbers::pi / 180, tangent = std::tan(half);
    rows.push_back(
        {.id = fmt::format("threshold.wedge_{:.3g}", degrees),
         .statement = "a wedge holds a ball whose friction exceeds the tangent of half its angle",
         .quantity = "least friction",
         .unit = "1",
         .formula = "tan(half angle)",
         .scene = fmt::format("ball between plates of {:.9g} degrees, pressed by 10 N", 2 * degrees),
         .method = contact_method("direct"),
         .bound = {.relative = 3e-4,
                   .derivation = "bisected to 1e-4; what slips is seen within 1 s at 1e-4 beyond"},
         .expected = [tangent] { return tangent; },
         .run =
             [=](const Method& method) {
               return threshold(0.98 * tangent, 1.02 * tangent, 1e-4 * tangent, [&](double friction) {
                 const Scene scene = wedge(2 * half, friction);
                 return (state_after(scene, method, contact_h, 100).x - scene.initial.x)
                            .rightCols<1>()
                            .norm() < 1e-6;
               });
             }});
  }
}

}  // namespace pbdcheck::ledger
