// Scenes of `stack`.
#pragma once

#include "step/step.h"

namespace pbdcheck {

/// Bricks of 0.2 m at the edge of a table, overhanging by `share` of the most that stands (harmonic sum).
pbd::Scene overhang(int count, double share);

/// N, what the colliders below `first` push those from there on with.
pbd::Vec3 force_across(const pbd::Workspace& workspace, int first);

}  // namespace pbdcheck
