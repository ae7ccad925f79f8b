// The order at which errors fall with the step or the mesh.
#pragma once

#include <string_view>
#include <vector>

namespace pbdcheck {

/// Slope of log(error) over log(h) by least squares; NaN for less than two values, or one that is not finite
/// and > 0.
double fitted_order(const std::vector<double>& h, const std::vector<double>& error);

/// Of errors on ever finer levels: converging (each is smaller than the last), oscillating (the finest is
/// smaller than the coarsest, but not each than the last) or diverging (anything else, NaN included).
std::string_view behaviour_of(const std::vector<double>& error);

}  // namespace pbdcheck
