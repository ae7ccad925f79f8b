// How a case of `point_hard_cases` is run: its gates, and how far step and budget can be pushed.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "studies/robustness/gates.h"

namespace pbdcheck {

struct PointFrontier {
  double largest_step = std::nan("");    // s, up to which all gates hold
  double largest_solved = std::nan("");  // s, up to which every step is ok, too
  double fewest_sweeps = std::nan("");   // an outer iteration, from which on all gates hold
  std::int64_t passed = 0, tried = 0;    // runs of both ladders
};

struct PointOutcome {
  std::string scene;
  double h;  // s
  pbd::Method method;
  Simulated simulated;
  PointFrontier frontier;
  bool relaxes = true;  // false: the relaxation has no part in it
};

/// Each is tried as the one relaxation for all cases; the first is the default, which the verdicts are about,
/// and which alone the full tier watches longer.
inline constexpr std::array<const char*, 3> one_for_all{"conjugate_gradients", "direct", "gauss_seidel"};

/// One for each of these relaxations, one alone where nothing is relaxed.
std::vector<PointOutcome> outcomes_of(const HardCase& each, bool full_tier);

/// The same scene in nine systems of units: largest difference of the end positions from those in SI.
PointOutcome other_units(const std::string& name, const pbd::Scene& scene, const std::string& relaxation,
                         int steps);

/// A rest shape without volume is refused before anything is computed.
PointOutcome flat_rest();

}  // namespace pbdcheck
