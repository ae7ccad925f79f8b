// A state as constraints are evaluated at.
#pragma once

#include <vector>

#include "rows/bodies.h"

namespace pbdcheck {

class Placed {
 public:
  Placed(const pbd::Scene& scene, const pbd::State& state) : time_(state.time) {
    pbd::Bodies bodies(scene);
    pbd::Points v;
    bodies.begin(state, x_, v);
    bodies.place(x_, poses_);
  }

  pbd::Configuration at() const { return {x_, poses_, time_}; }

 private:
  pbd::Points x_;
  std::vector<pbd::Pose> poses_;
  double time_;
};

}  // namespace pbdcheck
