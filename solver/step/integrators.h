// An integrator is one function that gives the coefficients of a step of h seconds. With x_l, v_l the state
// where the step begins, f the accelerations by given forces, q_l those by all forces there, and a_l one that
// the integrator carries from step to step, they make an affine map of the velocity v that is solved for:
//   x = x0 + d v,              x0     = x_l + x_v v_l + x_a a_l + before (x_l - x_l-1)
//   M (v - v_free) = J(x)^T p, v_free = v_l + s f + v_q q_l + v_a a_l + before (v_l - v_l-1)
// with impulses p that are s times the constraints' forces: a row's bias is c(x_k)/d - J v_k, its Sigma
// A/(s d). The step ends at x_l + extension (x - x_l) with the velocity v_l + extension (v - v_l) and carries
// on a_l+1 = (v - v_l - a_a a_l)/a_v.
//   implicit_euler    x_l+1 = x_l + h v_l+1,  v_l+1 = v_l + h q_l+1
//   newmark           x_l+1 = x_l + h ((1-alpha) v_l + alpha v_l+1), v_l+1 = v_l + h ((1-alpha) q_l + alpha
//                     q_l+1); with beta and gamma Newmark's own family (newmark1959method):
//                     x_l+1 = x_l + h v_l + h^2 ((1/2-beta) q_l + beta q_l+1), v_l+1 = v_l + h ((1-gamma) q_l
//                     + gamma q_l+1). alpha = 1/2 is the trapezoidal rule (beta = 1/4, gamma = 1/2), alpha =
//                     1 implicit Euler.
//   generalised_alpha Newmark's x and v with a for q, (1-alpha_m) a_l+1 + alpha_m a_l = (1-alpha_f) q_l+1 +
//                     alpha_f q_l, alpha_m = (2 rho - 1)/(rho + 1), alpha_f = rho/(rho + 1), gamma = 1/2 +
//                     alpha_f - alpha_m, beta = (gamma + 1/2)^2/4 (chung1993time; with constraints
//                     arnold2007convergence)
//   bdf2              with w = h/h_l-1: y_l+1 = y_l + w^2/(1+2w) (y_l - y_l-1) + h (1+w)/(1+2w) y'_l+1
//   midpoint          q and v at the middle: an implicit Euler step of h/2, carried on as far again
//   symplectic_euler  v_l+1 = v_l + h q_l, x_l+1 = x_l + h v_l+1; hard constraints met at the end along their
//                     directions at the start (SHAKE: ryckaert1977numerical)
// Impulses of contacts act as a step ends: q_l, a_l and v_l-1 are those of the motion without them (the
// smooth part of bruls2014simultaneous), but for a_l in x0, so that what rests stays at rest. A step in which
// something strikes, by contact or at a one-sided limit, is one of implicit Euler, and the next one is a
// start: nothing goes on of what jumps. newmark alone carries on where all that strikes comes back, contact
// by a restitution or an undamped compliance, and no constraint is hard. To all but bdf2 steps in which a
// hard limit holds something are those of implicit Euler, too. A start knows the forces of compliant
// constraints by their value, those of hard ones not: where there are any, all that carry something on begin
// with three steps of implicit Euler, since places and velocities of the start may be none that the
// constraints allow, so that the first two may jump. Without any bdf2 begins with one such step, and with
// contact generalised_alpha does; their order stays. A start is what a state begins that is not the last
// step's end, what follows a diverged step, and where whoever leads the scene says so
// (`Workspace::begin_anew`).
//
// Limits: newmark with alpha below about 0.52, generalised_alpha with rho above about 0.9 and midpoint are
// unstable with hard constraints (the trapezoidal rule on an equation of index 3); left at one outer
// iteration a step the first two were seen to blow up with more damping of their own, too. midpoint meets
// constraints in the middle of a step, not at its end. symplectic_euler is stable below h = 2/w alone, w the
// stiffest compliant mode; damping, implicit elsewhere, narrows that. bdf2 with changing steps is stable
// while one is at most 2.4 times the one before; with damping it takes a rest value that is changed between
// steps for a rate.
#pragma once

#include <string_view>
#include <vector>

#include "method.h"
#include "rows/step_map.h"

namespace pbd {

/// What an integrator knows of a step.
struct StepStart {
  const Method& method;
  double h;           // s
  double last_h;      // s, of the step before; infinite at a start
  bool forces_known;  // at the step's begin: q_l and a_l are there
};

/// What has to be kept for the next step: nothing, x_l-1 and v_l-1, or q_l and a_l.
enum class Keeps { nothing, states, accelerations };

struct Integrator {
  std::string_view name;
  int order;              // of accuracy in h, with the method's default parameters
  std::string_view text;  // on its order and parameters
  StepCoefficients (*coefficients)(const StepStart& start);
  Keeps keeps = Keeps::nothing;
  bool explicit_forces = false;  // compliant constraints act as given forces, hard ones along J(x_l)
  bool contact = false;          // allowed
  bool begins_anew = false;      // at impacts, by a step of implicit Euler
  bool rebounds = false;         // but carries on past those that come back, where no constraint is hard
};

/// Its step, and that of all where something strikes.
StepCoefficients implicit_euler(const StepStart& start);

/// All integrators.
const std::vector<Integrator>& integrators();

}  // namespace pbd
