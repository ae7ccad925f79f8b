// What must hold of a simulation, however hard the scene: measured numbers and their bounds.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "residual.h"
#include "step/step.h"
#include "studies/robustness/hard_cases.h"

namespace pbdcheck {

struct Gate {
  std::string_view name;
  double measured;
  double bound;
  std::string skipped{};  // why it was not measured; empty if it was

  bool holds() const { return skipped.empty() && measured >= 0 && measured <= bound; }  // NaN never holds
  bool fails() const { return skipped.empty() && !holds(); }
};

struct Simulated {
  std::vector<Gate> gates;
  pbd::State end;
  std::int64_t steps = 0, steps_ok = 0, sweeps = 0;
  pbd::Status worst = pbd::Status::ok;
  std::string reason;  // of the first step with that status
};

/// True if no gate fails.
bool all_hold(const std::vector<Gate>& gates);

/// How long, and how closely watched.
struct Watch {
  int steps;         // at least
  int most_steps;    // a scene that needs more to settle is not asked to
  int judged_steps;  // whose end the judge evaluates
};

/// Simulates a case by steps of h seconds and measures its gates:
///   finite     number of coordinates at the end, and of steps, that are not finite or diverged
///   energy     largest excess, 0 if there is none, of kinetic + elastic energy over that of the start and
///              the work of gravity and forces, as part of the start's + (m g + |f|) L
///   hard_rows  largest error of a hard link, as part of its length
///   claims     largest residual found by the judge after a step with status ok, as part of what the status
///              allows
///   residual   number of steps that gave up without having improved on their first residual
///   settles    kinetic energy after settling_steps, as part of m g L
///   tension    largest relative error of a hanging rope's tension
///   recovers   distance of the worst node from the rest shape, rigidly placed, as part of L
Simulated simulate(const HardCase& each, const pbd::Method& method, double h, const Watch& watch);

/// The judge's residual of a step that says ok, as part of what its tolerance allows: sqrt(2) of that for the
/// two residuals, each within the tolerance or rounding.
double claim_share(const pbd::reference::StepResidual& judged, double tolerance);

}  // namespace pbdcheck
