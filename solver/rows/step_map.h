// A step as an affine map of the velocity v that is solved for (integrators.h):
//   x = x0 + d v,   M (v - v_free) = J(x)^T p,   a row's bias c(x_k)/d - J v_k, its Sigma A/(s d); of
//   contacts A/(h d)
#pragma once

#include "geometry.h"

namespace pbd {

struct StepMap {
  Points x0;      // m
  Points v_free;  // m/s
  double d = 0;   // s
  double s = 0;   // s
  double h = 0;   // s, of the whole step, in which impulses of contacts act
};

/// What an integrator makes of a step of h seconds.
struct StepCoefficients {
  double d, s;           // s
  double extension = 1;  // 1, of the motion to x(v), at whose end the step ends
  double x_v = 0;        // s
  double x_a = 0;        // s^2
  double v_q = 0;        // s
  double v_a = 0;        // s
  double before = 0;     // 1
  double a_a = 0;        // s
  double a_v = 0;        // s; 0 carries nothing on
};

}  // namespace pbd
