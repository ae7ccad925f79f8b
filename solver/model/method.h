// How a step is solved.
#pragma once

#include <optional>
#include <string>

#include "friction.h"

namespace pbd {

/// Names are those of the lists in step/integrators.h, outer/outer.h, linear/linear_solver.h and friction.h.
struct Method {
  std::string integrator = "implicit_euler";
  std::string outer = "auto";
  std::string relaxation = "conjugate_gradients";
  std::string friction = "coulomb";
  double tolerance = 1e-8;         // on the residuals, relative to `scale`
  int max_outer = 100;             // outer iterations a step
  int max_sweeps = 1000;           // sweeps of the relaxation an outer iteration
  double inner_tolerance = 0.003;  // end an outer iteration's sweeps at this share of the nonlinear residual
  bool warm_start = true;          // begin with the previous step's impulses
  int threads = 1;                 // that a step's loops are divided among; no result depends on it
  int memory = 20;                 // iterates that proximal and quasi_newton learn from
  double alpha = 0.55;  // of newmark, 1/2 to 1: its weight of the step's end; 1/2 conserves energy where all
                        // is linear, and is unstable with hard constraints
  std::optional<double> beta, gamma;  // of Newmark's own family, which newmark is if both are given
  double rho = 0.8;  // of generalised_alpha, 0 to 1: what a step leaves of infinitely fast oscillations
  double direction_blend = 1;  // J is taken at x_l + this (x - x_l): 0 where the step begins, 1 at its end
  double stabilisation = 1;    // share of a hard constraint's error that `frozen` removes in a step
                               // (baumgarte1972stabilization)
};

/// Throws SetupError naming the parameter that is out of its range.
void validate(const Method& method);

}  // namespace pbd
