// From a scene's effects to what the solver sees of them: sources of rows, and given accelerations.
#pragma once

#include "rows/constraint.h"
#include "rows/source.h"

namespace pbd {

/// The source of an effect's rows, null of a given force. It refers to the scene, which must stay where it
/// is. Contacts obey `law`.
std::unique_ptr<Source> make_source(const Scene& scene, const Effect& effect, Friction law);

/// Sources of all effects with rows, in the scene's order, and their blocks: those of all constraints, or of
/// the hard ones alone. Impulses are zero.
std::vector<Slot> make_slots(const Scene& scene, Friction law, bool hard_alone, Rows& rows);

/// Sets the sum of the given forces' accelerations, m/s^2, of all columns.
void set_given_accelerations(const Scene& scene, const ForceBegin& begin, Points& acceleration);

}  // namespace pbd
