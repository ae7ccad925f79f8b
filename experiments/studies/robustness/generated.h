// Scenes nobody would draw: random points under random combinations of all effects.
#pragma once

#include <cstdint>

#include "harness/cases.h"

namespace pbdcheck {

/// Scene `index` of the sequence begun by pbdcheck::seed, and a step of 1 ms to 1 s: 2 to 20 nodes in a box
/// of 1 m, a few held, masses of 1e-4 to 1e4 kg; each effect is there or not; compliances and Young's moduli
/// over eight decades, hard rows among them. Rest shapes are up to a tenth, rest lengths up to half off.
Case generated_case(std::int64_t index);

}  // namespace pbdcheck
