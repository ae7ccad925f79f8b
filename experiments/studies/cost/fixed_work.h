// Runs that do the same work whatever a scene makes of it, so that the times of two scenes compare.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "step/step.h"

namespace pbdcheck {

struct FixedRun {
  pbd::State end;
  double seconds;
  std::vector<pbd::EffectCost> costs;
};

/// Steps of twice ten sweeps of Gauss-Seidel by an outer iteration.
struct FixedWork {
  static constexpr int steps = 20;
  /// What is done after each step, with the state where it ends.
  using AfterStep = std::function<void(const pbd::Workspace&, const pbd::State&)>;

  std::string_view outer;
  int turns;  // runs of each scene, of which the quickest counts

  FixedRun run(const pbd::Scene& scene, const AfterStep& after = {}) const;

  /// time of a, with what is done after its steps / time of b: of each of five repeats, from runs in turns,
  /// after a discarded pair.
  std::vector<double> time_ratios(const pbd::Scene& a, const pbd::Scene& b,
                                  const AfterStep& after_a = {}) const;
};

}  // namespace pbdcheck
