// Steps of bodies in contact made by hand, true ones.
#pragma once

#include "claimed_step.h"
#include "scenes/contacts.h"

namespace pbd::test {

/// A box of 4 kg and 0.1 m height on the ground, as contacts() counts them: 0 the ground, 1 the box.
inline Step box_on_ground(double friction, double speed) {
  pbdcheck::BodyScene scene(ContactLaw{.friction = friction}, weight_per_kg);
  scene.ground();
  scene.box({0.2, 0.2, 0.1}, 4, {.position = {0, 0, 0.05}, .velocity = {speed, 0, 0}});
  Step step(scene.finish());
  const double drag = speed > 0 ? friction * 4 * weight_per_kg : 0;
  step.end.v.col(1).x() -= Step::h * drag / 4;
  step.move();
  // Friction turns the box forward: the pressure moves so far ahead that it does not turn.
  const double ahead = drag * 0.05 / (4 * weight_per_kg), share = ahead / 0.2;
  for (const double x : {-0.1, 0.1})
    for (const double y : {-0.1, 0.1}) {
      const double part = 0.25 + (x > 0 ? share : -share) / 2;
      step.contacts.push_back({.collider = {1, 0},
                               .point = step.end.x.col(1) + Vec3(x, y, -0.05),
                               .normal = Vec3::UnitZ(),
                               .force = {-drag * part, 0, 4 * weight_per_kg * part},
                               .gap = 0});
    }
  return step;
}

/// Balls of 0.1 m; the first meets the second, without restitution, and both go on together.
inline Step balls() {
  pbdcheck::BodyScene scene(ContactLaw{.friction = 0}, 0);
  scene.ball(0.1, 1, {.position = {-0.102, 0, 0}, .velocity = {1, 0, 0}});
  scene.ball(0.1, 3, {.position = {0.1, 0, 0}});
  Step step(scene.finish());
  // The gap of 2 mm closes: v0 - v1 = 0.2 m/s, v0 + 3 v1 = 1 m/s.
  const double after = 0.2;
  step.end.v.col(0).x() = after + 0.2;
  step.end.v.col(1).x() = after;
  step.move();
  step.contacts.push_back({.collider = {0, 1},
                           .point = (step.end.x.col(0) + step.end.x.col(1)) / 2,
                           .normal = -Vec3::UnitX(),
                           .force = {-3 * after / Step::h, 0, 0},
                           .gap = 0});
  return step;
}

}  // namespace pbd::test
