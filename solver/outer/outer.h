// An outer iteration turns the linearisation at one iterate into the next iterate. All end where they stop
// moving; only some of them end at the solution of the step.
//
//   plain        v <- v_free + W J_k^T p, then relax
//   incremental  relax from v as it is; only the first iterate is v_free + W J^T p
//   frozen       as plain, but always linearised at x0
//   aitken, proximal, quasi_newton, auto   in files of their own
//
// In plain the whole multiplier acts along the current directions (francu2017position); its fixed points are
// the solutions of the step. It leaves out the geometric stiffness K = -d sum_i p_i d2c_i: its error is
// multiplied by -K/(M + material stiffness) on the motions that the hard rows allow. In incremental earlier
// impulses keep the directions they were found with, as in position based dynamics and XPBD
// (macklin2016xpbd), with Jacobians refreshed once an outer iteration: it meets the constraints, not the
// equations of motion. frozen is velocity time stepping: it solves one linearisation, J v + stabilisation c/d
// = 0 at x0 for hard rows.
#pragma once

#include <optional>
#include <variant>

#include "outer/automatic.h"
#include "outer/outer_names.h"

namespace pbd {

struct Plain {
  static constexpr bool solves_step = true;
  void iterate(StepSystem& system, Progress& progress);
};
struct Incremental {
  static constexpr bool solves_step = false;
  void iterate(StepSystem& system, Progress& progress);
};
struct Frozen {
  static constexpr bool solves_step = false;
  Points rest{};  // velocities zero, where x = x0

  void iterate(StepSystem& system, Progress& progress);
};
using OuterIteration = std::variant<Plain, Aitken, Incremental, Frozen, Proximal, QuasiNewton, Automatic>;

/// A fresh one by name (SetupError if unknown).
OuterIteration make_outer(std::string_view name, StepSystem& system);

/// Throws SetupError if there is none of that name.
void require_outer(std::string_view name);

/// Gets ready for a step; the iterate is its start.
void begin(OuterIteration& outer, StepSystem& system);

/// Linearises, or whatever else the iteration works on, at the iterate; returns the residual of the rows.
RowResidual refresh(OuterIteration& outer, StepSystem& system);

void iterate(OuterIteration& outer, StepSystem& system, Progress& progress);

/// The iterate or the rows have been changed from outside: what was learnt of them in this step is forgotten.
void forget(OuterIteration& outer);

/// The stiffness of an effect is another now.
void forget_stiffness(OuterIteration& outer);

/// After the last iterate.
void end(OuterIteration& outer, StepSystem& system);

/// As in quasi_newton.h: nothing where there is nothing to settle.
std::optional<RowResidual> settle(OuterIteration& outer, StepSystem& system, const Progress& progress,
                                  bool stalled);
void unsettle(OuterIteration& outer, StepSystem& system);

/// True if the next iteration is another one, so that it does not matter that the last one stalled.
bool takes_over(const OuterIteration& outer);

/// True if it works on a potential, where the bounds of the contraction are all that is asked for.
bool on_potential(const OuterIteration& outer);

/// True if its fixed points are the solutions of the step: an iterate of less residual is a better one.
bool solves_step(const OuterIteration& outer);

}  // namespace pbd
