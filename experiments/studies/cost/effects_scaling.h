// The part of the experiment `effects_cost` that asks how the time of a sweep grows.
#pragma once

#include "harness/experiment.h"

namespace pbdcheck {

/// The table `scaling` and its verdicts.
void effects_scaling(Context& context);

}  // namespace pbdcheck
