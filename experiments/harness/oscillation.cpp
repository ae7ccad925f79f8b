#include "harness/oscillation.h"

#include <cmath>

namespace pbdcheck {

pbd::reference::Discrete sampled_oscillation(double a, double b, double c, double d) {
  const double square = (d * b - c * c) / (c * a - b * b);
  return {std::sqrt(square), std::acos((d + square * b) / (2 * std::sqrt(square) * c))};
}

}  // namespace pbdcheck
