// Features of two rigid surfaces that need no force, since a plane parts the surfaces however these features
// meet: as where one slides level from a table to the next one, whose side is in front of it.
//
// Not so where the contact yields, or velocities lead the surfaces through the plane. Planes are those of the
// faces of both: sep(m) as in support.h, but of the surfaces' corners. Features close their gap along their
// normal n, and go on by ten times what is overlooked: sep falls by m . n times that.
#pragma once

#include "placed_surface.h"

namespace pbd::reference {

/// Drops such pairs from `first` on, where a's velocity against b leads by `way` (m). What is less than a
/// millionth of the smaller surface is overlooked.
void drop_parted(const PlacedSurface& a, const PlacedSurface& b, const Vec3& way, const Placement& at,
                 std::size_t first, std::vector<FeaturePair>& found);

}  // namespace pbd::reference
