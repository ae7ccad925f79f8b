// What `auto` costs where `plain` would do.
#pragma once

#include <string>
#include <vector>

#include "harness/experiment.h"
#include "judge.h"

namespace pbdcheck {

/// A step of a map, and its solution by the judge.
struct SolvedStep {
  std::string scene, parameter;  // what the map varies beside the step
  double value = 0;              // of the parameter
  Case step;
  pbd::State start{};
  pbd::reference::Judgement exact{};
};

/// Does the steps that `plain` contracts to by both, at the default tolerance: writes the table `cost` and
/// the verdict.
void auto_cost(Context& context, const std::vector<const SolvedStep*>& all);

}  // namespace pbdcheck
