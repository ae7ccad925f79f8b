// Mechanisms whose places after a time are known: benchmarks of the IFToMM library; the parts of `joints`.
#pragma once

#include <string>
#include <vector>

#include "harness/experiment.h"
#include "scene.h"

namespace pbdcheck {

using Values = std::vector<double>;

struct Mechanism {
  std::string name;
  pbd::Scene scene;
  double duration;     // s
  int coarsest_steps;  // of the first level
  int levels;
  Values expected;  // m or rad, at the end
  double size;      // what errors are relative to
  Values (*values)(const pbd::State&);
  double farthest = 0;  // m, of a place under gravity from the origin; 0: there is no gravity
};

/// beta, theta, gamma, phi, delta, omega, epsilon of Andrews' mechanism.
Values squeezer_angles(const pbd::State& state);
/// Of a slider-crank; a motor's place does not depend on the step.
Values slider_place(const pbd::State& state);

std::vector<Mechanism> known_mechanisms(bool full);

/// What a chain of bodies costs over its length: the table `lengths` and its verdicts.
void joint_lengths(Context& context);

}  // namespace pbdcheck
