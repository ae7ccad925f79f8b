// What the residuals of a step are compared with, and what follows.
#pragma once

#include <limits>

#include "outer/step_system.h"
#include "step/report.h"

namespace pbd {

inline constexpr double rounding_unit = std::numeric_limits<double>::epsilon();
inline constexpr std::string_view not_finite = "not finite";

/// Of a body in a step, rad: the rounding of more exceeds 1e-8 rad.
inline constexpr double most_turn = 1e-8 / rounding_unit;

/// What the residuals of a step are compared with.
struct Levels {
  double free_change = 0, free_speed = 0;         // |v_free - v_l|_M, |v_free|_M
  double primal_rounding = 0, dual_rounding = 0;  // what rounding makes of the residuals
  double velocity_rounding = 0;                   // of it, that of velocities
  double primal_beyond = 0, beyond_rounding = 0;  // primal and dual one of what misses more than its own
  double first = 0;                               // the larger of residual and scale at the first iterate
  double last_residual = infinity;                // of this step
};

/// Residuals, scale and rounding level of the iterate. `effects` is scratch.
void measure(const StepSystem& system, const RowResidual& found, std::vector<double>& effects, Levels& levels,
             Progress& progress);

/// Sets status and reason; true if the outer iteration is to end.
bool finished(const Method& method, const Levels& levels, const Progress& progress, Report& report);

/// The constraint of rows, linearised at the iterate, that misses most; none where all are met.
std::optional<ConstraintIndex> worst_constraint(const StepSystem& system);

}  // namespace pbd
