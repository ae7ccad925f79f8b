// Runs that do the same work whatever a scene makes of it, so that the times of two scenes compare.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "step/step.h"

namespace pbdcheck {

struct FixedRun {
  pbd::State end;
  double first, later;  // s: the first step, which builds what later ones keep, and all of those
  std::vector<pbd::EffectCost> costs;
};

/// Times of a scene beside those of another one.
struct TimesBeside {
  std::vector<double> ratios;  // of each repeat, of the steps after the first
  double first;                // by how many later steps of the other one its first step takes longer
};

/// Steps of twice ten sweeps of Gauss-Seidel by an outer iteration.
struct FixedWork {
  static constexpr int steps = 20;
  /// What is done after each step, with the state where it ends.
  using AfterStep = std::function<void(const pbd::Workspace&, const pbd::State&)>;

  std::string_view outer;
  int turns;  // runs of each scene, of which the quickest counts

  FixedRun run(const pbd::Scene& scene, const AfterStep& after = {}) const;

  /// a, with what is done after its steps, beside b: five repeats, from runs in turns, after a discarded
  /// pair.
  TimesBeside beside(const pbd::Scene& a, const pbd::Scene& b, const AfterStep& after_a = {}) const;
};

}  // namespace pbdcheck
