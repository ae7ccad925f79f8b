// The way to the step that `compare` compares.
#pragma once

#include <optional>
#include <string>

#include "integrator_map.h"
#include "scenes/scene_file.h"
#include "step/step.h"

namespace pbdcheck {

/// The scene's own method on that way, and what a reference has to know of it.
struct Way {
  SceneFile& file;
  pbd::Workspace workspace;
  pbd::State state;
  pbd::reference::IntegratorMemory memory;
  int missed = 0;  // steps that missed their tolerance

  /// `integrator` is that of the compared step. The file is to stay where it is.
  Way(SceneFile& own, const std::string& integrator);

  /// Makes `steps` steps. Throws std::runtime_error if one diverged.
  void go(int steps);

  /// The compared step's; none if that is implicit Euler's. The scene's own method says whether something
  /// strikes in it.
  std::optional<pbd::reference::IntegratorMap> map() const;
};

}  // namespace pbdcheck
