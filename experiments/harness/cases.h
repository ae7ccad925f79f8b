// The steps that experiments do: a scene, its state before the step, the step's length.
#pragma once

#include <string>
#include <vector>

#include "scene.h"

namespace pbdcheck {

struct Case {
  std::string name;
  pbd::Scene scene;
  double h;              // s, of the step in question
  double lead_step = 0;  // s
  int lead_steps = 0;    // steps of `lead_step` by `truth` from the scene's initial state to the step's start
};

/// Chain of 20 links in the middle of its swing, its tip `ratio` times as heavy as the other nodes.
Case swinging_chain(double ratio, double h);

/// Chain of 10 rods with ball joints in the middle of its swing, its last rod `ratio` times as heavy.
Case swinging_rods(double ratio, double h);

/// The axes of maps over step (s) and mass ratio of that chain.
std::vector<double> chain_ratios(bool full);
std::vector<double> chain_steps(bool full);

}  // namespace pbdcheck
