// The part of the experiment `threads` that asks how near sweeps over each effect's rows come to what the
// machine could do (williams2009roofline).
#pragma once

#include <vector>

#include "harness/experiment.h"

namespace pbdcheck {

/// How many calls of `advance` the part makes.
std::int64_t roofline_count();

/// The table `roofline` and its verdict. `copied` are bytes a second that copying moves, on one thread, on
/// two, and so on.
void roofline(Context& context, const std::vector<double>& copied);

}  // namespace pbdcheck
