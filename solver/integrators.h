// An integrator is one function giving an affine map of the step: end positions x = x0 + d v of the end
// velocity v, the velocity v_free without impulses, and the scale s that turns forces into impulses. A row's
// bias is then c(x_k)/d - J v_k and its Sigma A/(s d).
//   implicit_euler   x0 = x_l, v_free = v_l + h a, d = s = h
#pragma once

#include <string_view>
#include <vector>

#include "scene.h"

namespace pbd {

struct StepMap {
  Points x0;      // m
  Points v_free;  // m/s
  double d = 0;   // s
  double s = 0;   // s
};

/// Fills `map` for a step of h seconds from `state` under the given forces' accelerations (m/s^2).
using IntegratorFunction = void (*)(const State& state, const Points& acceleration, double h, StepMap& map);

struct Integrator {
  std::string_view name;
  int order;  // of accuracy in h
  IntegratorFunction map;
};

/// All integrators.
const std::vector<Integrator>& integrators();

}  // namespace pbd
