// A step made by hand, and what the judge of steps refutes of it.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rigid_model.h"
#include "scene.h"
#include "step_check.h"

namespace pbd::test {

/// A step and all that is claimed of it, to be changed by one number.
struct Step {
  static constexpr double h = 0.01;  // s

  Scene scene;
  State end;
  std::vector<std::vector<double>> forces;
  std::vector<reference::ClaimedContact> contacts;
  double scale = 1;
  std::string_view integrator = "implicit_euler";
  Friction friction = Friction::coulomb;

  explicit Step(Scene stated) : scene(std::move(stated)), end(scene.initial) {
    forces.resize(scene.effects.size());
    end.time += h;
  }

  /// x and R where the end velocities take them.
  void move() {
    end.x = scene.initial.x + h * end.v;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
      end.orientation[b] = reference::turned_by(scene.initial.orientation[b], h * end.spin.col(int(b)));
  }

  reference::Findings judge(double tolerance = 1e-8) const {
    reference::StepClaim claim{.scene = scene, .start = scene.initial, .end = end, .h = h};
    claim.integrator = integrator;
    claim.friction = friction;
    claim.tolerance = tolerance;
    claim.scale = scale;
    claim.forces = forces;
    claim.contacts = contacts;
    return reference::StepCheck(scene).judge(claim);
  }
};

constexpr double weight_per_kg = 9.81;  // N/kg, of Gravity{}

/// A mass on a hard link of 1 m that its step leaves longer by `missed` (m): the free step, back to the
/// circle.
inline Step swinging_link(double missed = 0) {
  Scene scene;
  add_node(scene, Vec3::Zero(), infinity);
  add_node(scene, Vec3(1, 0, 0), 2, Vec3(0, 0, -1));
  scene.effects.emplace_back(Gravity{});
  scene.effects.emplace_back(Distance{.node = {{0, 1}}, .rest_length = {1}, .compliance = {0}});
  Step step(scene);
  const Vec3 free(1, 0, -Step::h * (1 + Step::h * weight_per_kg));
  step.end.v.col(1) = ((1 + missed) * free.normalized() - Vec3(1, 0, 0)) / Step::h;
  step.move();
  step.forces[1] = {-2 * (free.norm() - 1) / (Step::h * Step::h)};  // M (x1 - free)/h^2 = J^T gamma
  return step;
}

using Names = std::set<std::string>;

/// Of the checks that refute it.
inline Names refuted(const Step& step) {
  Names names;
  for (const auto& finding : step.judge().refuted) names.insert(finding.check);
  return names;
}

}  // namespace pbd::test
