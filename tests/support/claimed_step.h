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
    claim.tolerance = tolerance;
    claim.scale = scale;
    claim.forces = forces;
    claim.contacts = contacts;
    return reference::StepCheck(scene).judge(claim);
  }
};

using Names = std::set<std::string>;

/// Of the checks that refute it.
inline Names refuted(const Step& step) {
  Names names;
  for (const auto& finding : step.judge().refuted) names.insert(finding.check);
  return names;
}

}  // namespace pbd::test
