// What a sequence of a coordinate's values says of the oscillation that it samples.
#pragma once

#include "closed_form.h"

namespace pbdcheck {

/// r and phi of a sequence q_l+1 = 2 r cos(phi) q_l - r^2 q_l-1, 0 < phi < pi, from four values in a row.
pbd::reference::Discrete sampled_oscillation(double a, double b, double c, double d);

}  // namespace pbdcheck
