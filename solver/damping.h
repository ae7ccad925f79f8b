// Damping as a change of value and compliance. A constraint's value follows the integrator's rule for
// positions (integrators.h), so that its rate belongs to the velocity v:
//   dc/dt = (c - c0)/d,   c0 = c_l + J_l (x_v v_l + x_a a_l) + before (c_l - c_l-1) + k v_l^T c'' v_l
// with k = x_a, and less d^2/2 where x is no position of the motion but the middle of a chord (midpoint).
// Implicit Euler has c0 = c_l. Then c + T dc/dt + A gamma = 0 is
//   c - offset + (1 + T/d)^-1 A gamma = 0,   offset = (1 - (1 + T/d)^-1) c0.
// For solids (1 + T/d)^-1 A is the inverse of V (C + C_d/d). It is the gradient of a potential: elastic
// energy and d/2 (dc/dt)^T A^-1 T (dc/dt) (Servin, Lacoursiere, Melin 2006).
#pragma once

#include "bodies.h"
#include "integrators.h"
#include "rows.h"

namespace pbd {

/// Where a step begins, and d further and back along its velocities v.
struct DampingBegin {
  const Configuration &at, &ahead, &behind;
  const Points& v;
};

/// Sets offset and compliance of a block whose effect lists damping for a step from `begin`, a the
/// acceleration that the integrator carries on (empty if none). Later linearisations keep both.
void begin_damping(const Effect& effect, const StepCoefficients& coefficients, const DampingBegin& begin,
                   const Points& a, AnyBlock& block);

/// True if c0 has a term k v_l^T c'' v_l: `ahead` and `behind` are read.
bool bends(const StepCoefficients& coefficients);

}  // namespace pbd
