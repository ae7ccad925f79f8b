// Turns that joints cannot tell. What holds a body's orientation has the same value after a whole turn, and
// what holds its axis after half a turn over, so that a solution may end there: met to rounding, by a motion
// that the joint forbids. An angle is the same after a whole turn: a motor that drives by more than half a
// turn a step is met by turning backwards, and a stop or a lock by as many turns as are there. What turns
// away from a stop at one side alone has it on the other side after half a turn.
#pragma once

#include "outer/step_system.h"

namespace pbd {

/// True if a body that rows other than contacts' act on turns by more than half a turn by the part d v of the
/// step's displacement (the whole of it but by midpoint and newmark with alpha = 1/2), and by as much
/// otherwise than by its free motion; if on the way of the step a hard joint that holds directions opens by
/// more than 60 degrees; if bodies turn about the axis of an angle, motor or limit by more than half a turn
/// otherwise than it drives them, or past half a turn from a stop; if a motor drives by more than half a
/// turn.
bool turned_round(const StepSystem& system);

}  // namespace pbd
