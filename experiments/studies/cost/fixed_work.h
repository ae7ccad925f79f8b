// Runs that do the same work whatever a scene makes of it, so that the times of two scenes compare.
#pragma once

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

  std::string_view outer;
  int turns;  // runs of each scene, of which the quickest counts

  FixedRun run(const pbd::Scene& scene) const;

  /// time of a / time of b: of each of five repeats, from runs in turns, after a discarded pair.
  std::vector<double> time_ratios(const pbd::Scene& a, const pbd::Scene& b) const;
};

}  // namespace pbdcheck
