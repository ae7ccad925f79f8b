// What `compare` compares, as `--method` names it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/measure.h"
#include "rivals/rival.h"
#include "scenes/scene_file.h"

namespace pbdcheck {

/// A method, or the rival that its outer iteration (`rival`) and relaxation (the name) stand for.
struct Contender {
  std::string text;  // as given
  pbd::Method method;
  const pbd::rivals::NamedRival* rival = nullptr;
  std::int64_t steps = 1;  // of the motion

  /// The scene's step from `state`, watched; by another integrator than implicit Euler going on from
  /// `before`.
  Trace measure_once(const SceneFile& file, const pbd::State& state, const pbd::Workspace& before,
                     const pbd::Points& exact) const;
};

/// Of one step. Each text is "KEY=VALUE ..." on top of the file's method, or "rival=NAME" with tolerance and
/// max_outer at most. Throws SetupError, also for what the scene does not allow, for a method that stands
/// twice, and for integrators that differ, or are neither implicit Euler nor the file's own.
std::vector<Contender> parsed_contenders(const std::vector<std::string>& texts, const SceneFile& file);

/// Of motions from 0 to `until` (s). Each text is "KEY=VALUE ..." on top of the file's method, with any
/// integrator, and "step_s=VALUE" (s) if the step is not the file's. Throws SetupError, also for rivals,
/// which do single steps, and for steps that do not divide `until`.
std::vector<Contender> parsed_movers(const std::vector<std::string>& texts, const SceneFile& file,
                                     double until);

}  // namespace pbdcheck
