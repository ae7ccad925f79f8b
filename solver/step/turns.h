// Turns that joints cannot tell. What holds a body's orientation has the same value after a whole turn, and
// what holds its axis after half a turn over, so that a solution may end there: met to rounding, by a motion
// that the joint forbids. A motor that drives by more than half a turn a step is met by turning backwards.
#pragma once

#include "outer/step_system.h"

namespace pbd {

/// True if a body that rows other than contacts' act on turns by more than half a turn by the part d v of the
/// step's displacement (the whole of it but by midpoint and newmark with alpha = 1/2), and by as much
/// otherwise than by its free motion; if on the way of the step a hard joint that holds directions is open by
/// more than 60 degrees; if a motor drives by more than half a turn.
bool turned_round(const StepSystem& system);

}  // namespace pbd
