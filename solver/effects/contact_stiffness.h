// A bound of a contact's geometric stiffness (rows/constraint.h): how fast its normal and its lever arms turn
// the impulse as bodies and nodes move.
#pragma once

#include "effects/active_contact.h"
#include "rows/rows.h"
#include "rows/step_map.h"

namespace pbd {

/// Adds half the bound times d to `added_mass` (kg, one a column), of `factor` times the impulse of contact
/// i. Defined for the blocks of contacts.
template <class Block>
void add_contact_stiffness(const ActiveContact& contact, const StepMap& map, const Configuration& at,
                           double factor, const Block& block, std::size_t i, std::vector<double>& added_mass);

}  // namespace pbd
