// Turns that joints cannot tell. What holds a body's orientation has the same value after a whole turn, so
// that an iteration that goes astray may end a turn, or nearly so, away from the step's motion: met to
// rounding, and faster than anything brought it.
#pragma once

#include "outer/step_system.h"

namespace pbd {

/// True if a body that rows other than contacts' act on turns by more than half a turn by the part d v of the
/// step's displacement (the whole of it but by midpoint and newmark with alpha = 1/2), and by as much
/// otherwise than by its free motion.
bool turned_round(const StepSystem& system);

}  // namespace pbd
