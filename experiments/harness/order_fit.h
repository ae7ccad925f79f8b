// The order at which errors fall with the step or the mesh.
#pragma once

#include <string_view>
#include <vector>

#include "harness/verdict.h"

namespace pbdcheck {

/// Slope of log(error) over log(h) by least squares; NaN for less than two values, or one that is not finite
/// and > 0.
double fitted_order(const std::vector<double>& h, const std::vector<double>& error);

/// |exponent - 1| of each repeat: nearer to a linear cost than to n^(4/3), what dense bands of a cube's
/// factor would take of it, it is below `off_linear_bound`.
Measured off_linear(std::vector<double> exponents);
inline constexpr double off_linear_bound = 1.0 / 6;

/// Of errors on ever finer levels: converging (each is smaller than the last), oscillating (the finest is
/// smaller than the coarsest, but not each than the last) or diverging (anything else, NaN included).
std::string_view behaviour_of(const std::vector<double>& error);

}  // namespace pbdcheck
