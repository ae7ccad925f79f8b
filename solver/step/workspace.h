// What a Workspace owns.
#pragma once

#include "outer/contraction.h"
#include "outer/outer.h"
#include "step/history.h"
#include "step/restraint.h"
#include "step/step.h"

namespace pbd {

/// The iterate of the smallest residual.
struct BestIterate {
  double residual = infinity;  // sqrt(J)
  Points v;
  std::vector<double> rows;  // impulses and biases
};

struct WorkspaceData {
  Scene scene;
  Method method;
  StepSystem system;
  History history;
  OuterIteration outer;
  ContractionEstimate contraction;
  BestIterate best_early, best;  // of the first iterates with the rows, and of those after
  Restraint restraint;
  Points previous;              // m/s, v of the last outer iteration
  std::vector<double> effects;  // m/s, w times the sizes of the impulses on each column
  std::vector<double> share;    // of its way that each column of a missed step may go

  WorkspaceData(Scene stated_scene, Method stated_method);
  // Sources and the problem refer to scene and method.
  WorkspaceData(const WorkspaceData&) = delete;
  WorkspaceData& operator=(const WorkspaceData&) = delete;
};

}  // namespace pbd
