// Runs of contact scenes, and what their ground carries.
#pragma once

#include <catch2/catch.hpp>
#include <cmath>

#include "scenes/standard.h"
#include "step/step.h"

namespace pbd::test {

using pbdcheck::gravity;

inline Method contact_method(std::string_view relaxation, std::string_view friction = "coulomb") {
  Method method;
  method.relaxation = relaxation;
  method.friction = friction;
  method.tolerance = 1e-12;
  return method;
}

/// The state after `steps` steps that all say ok.
inline State run(const Scene& scene, const Method& method, double h, int steps, Workspace& workspace) {
  State state = scene.initial;
  for (int k = 0; k < steps; ++k) {
    const Report report = step(workspace, h, state);
    INFO(method.relaxation << " " << method.friction << " step " << k << " residual " << report.residual());
    REQUIRE(report.status == Status::ok);
  }
  return state;
}

inline State run(const Scene& scene, const Method& method, double h, int steps) {
  Workspace workspace(scene, method);
  return run(scene, method, h, steps, workspace);
}

inline double weight(const Scene& scene) {
  double mass = 0;
  for (const double own : scene.mass)
    if (std::isfinite(own)) mass += own;
  return mass * gravity;
}

/// N, what the ground (collider 0) carries.
inline Vec3 ground_force(const Workspace& workspace) {
  Vec3 sum = Vec3::Zero();
  for (const ContactForce& contact : workspace.contacts()) {
    if (contact.collider[1] == 0) sum += contact.force;
    if (contact.collider[0] == 0) sum -= contact.force;
  }
  return sum;
}

}  // namespace pbd::test
