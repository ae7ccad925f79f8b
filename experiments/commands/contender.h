// What `compare` compares, as `--method` names it.
#pragma once

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

  /// The scene's step from `state`, watched; by another integrator than implicit Euler going on from
  /// `before`.
  Trace measure_once(const SceneFile& file, const pbd::State& state, const pbd::Workspace& before,
                     const pbd::Points& exact) const;
};

/// Each text is "KEY=VALUE ..." on top of the file's method, or "rival=NAME" with tolerance and max_outer at
/// most. Throws SetupError, also for what the scene does not allow, for a method that stands twice, and for
/// integrators that differ, or are neither implicit Euler nor the file's own.
std::vector<Contender> parsed_contenders(const std::vector<std::string>& texts, const SceneFile& file);

}  // namespace pbdcheck
