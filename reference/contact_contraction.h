// What the plain outer iteration does beside the solution of a step with contact.
//
// Plain maps the iterate w to the v that solves the step's rows as they are linearised at x(w):
//   M (v - v_l)/h = f + J(w)^T gamma + D(w)^T r           r the contacts' forces, D their directions
//   c(w) + h J(w) (v - w) + A gamma = 0                   joints and constraints
//   u_n = g(w)/h + D_n(w) (v - w),  u_t = D_t(w) v
//   sticking  u_n = 0, u_t = 0       sliding  u_n = 0 (cone: mu |u_t|),  r_t = -mu r_n u_t/|u_t|
// Where no contact is about to open, to slide or to stick, which hold and which slide stays the same nearby:
// with F(v, gamma, r; w) the equations above, the error is multiplied by -(dF/d(v, gamma, r))^-1 dF/dw. Both
// derivatives are central differences of F.
// Spheres and corners of boxes on spheres and half spaces, by formulas of their own. A sphere or corner acts
// on a half space where it is, those of one pair on one level, that of the lowest; spheres act on each other
// in the middle of their gap.
#pragma once

#include "contraction.h"
#include "friction.h"
#include "step_claim.h"

namespace pbd::reference {

struct ContactContraction {
  Judgement solved;  // by Newton's method on F(v, gamma, r; v) = 0 from the claimed end; no multipliers
  Contraction rate;  // NaN without a margin: the map has a kink there
  int sticking = 0, sliding = 0;  // contacts that press
  /// How far from another state the nearest contact is: of sticking ones 1 - |r_t|/(mu r_n), of sliding ones
  /// |u_t| over the largest velocity, r_n over the largest r_n, and how far corners of a pair are apart along
  /// the normal over the largest way of a step: each of those on one level may become the lowest.
  double margin = 0;
};

/// At the end of the step of implicit Euler that is claimed, whose pressing contacts say what holds and
/// slides; law cone or coulomb, no overlap where it begins, fixed bodies at rest. Throws SetupError for other
/// shapes and laws, for restitution and compliance of contacts, and for gyroscopic torques.
ContactContraction plain_contraction_of_contacts(const StepClaim& claim);

}  // namespace pbd::reference
