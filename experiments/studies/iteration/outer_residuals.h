// How far the fixed points of the outer iterations are from the implicit Euler step.
#pragma once

#include "harness/experiment.h"

namespace pbdcheck {

/// Writes the table `residuals`: of each end the share of its correction v - v_free that no impulses along
/// the directions there explain, as the judge finds it.
void outer_residuals(Context& context);

}  // namespace pbdcheck
