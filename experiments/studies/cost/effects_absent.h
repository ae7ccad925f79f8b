// The parts of the experiment `effects_cost` that ask what effects cost that a scene does not use, and what
// the list of effects costs a scene that uses one.
#pragma once

#include "harness/experiment.h"

namespace pbdcheck {

/// The table `absent` and its verdicts.
void effects_absent(Context& context);

/// The table `stripped` and its verdict.
void effects_stripped(Context& context);

}  // namespace pbdcheck
