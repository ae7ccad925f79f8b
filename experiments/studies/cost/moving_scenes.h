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
  bool dear = false;                       // a step takes 10 ms and more: fewer methods in the quick tier
  bool resolved = false;  // steps resolve all its oscillations: errors fall at the integrator's order
  std::function<Truth(const MovingScene&)> exact{};  // an ODE or a closed form; empty: none
};

std::vector<MovingScene> moving_scenes(bool full);

}  // namespace pbdcheck
