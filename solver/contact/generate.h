// All points where two shapes touch or are about to.
#pragma once

#include <vector>

#include "contact/contact_point.h"
#include "shapes.h"

namespace pbd {

/// Appends the contact points of shapes a and b, placed in the world by their frames, whose gap is below
/// `margin` (m). Features are given in the shapes' own frames; `swapped` where the contact's a is b's.
void generate(const Shape& a, const Frame& at_a, const Shape& b, const Frame& at_b, double margin,
              std::vector<ContactPoint>& out);

}  // namespace pbd
