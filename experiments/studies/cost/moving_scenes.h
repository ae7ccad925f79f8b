// The scenes of `trajectories`: from small ones with known motions to cuts of the paper's three.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "harness/trajectory.h"

namespace pbdcheck {

struct MovingScene {
  std::string name;
  SceneFile file;
  double duration;        // s, short enough that neighbouring motions stay neighbours
  std::int64_t coarsest;  // steps of the first level; each next one has twice as many
  int levels;
  Setting finest;                          // measures the error bar, and is the truth where nothing better is
  std::vector<std::string> integrators{};  // of that
  // In the quick tier, for fewer methods; 1: a step takes 10 ms and more, 2: and by an outer iteration that
  // knows no potential 1 s and more.
  int dear = 0;
  bool resolved = false;  // steps resolve all its oscillations: errors fall at the integrator's order
  std::function<Truth(const MovingScene&)> exact{};  // an ODE or a closed form; empty: none
};

std::vector<MovingScene> moving_scenes(bool full);

}  // namespace pbdcheck
