// Features of two rigid surfaces that need no force, since a plane parts the surfaces however these features
// meet: as where one slides level from a table to the next one, whose side is in front of it.
//
// Nor does it yield, nor do their velocities lead them through it. Planes are those of faces, both surfaces'
// that have some: sep(m) as in support.h, but of the surfaces' corners. Features go on by their gap along
// their normal n, and by `farther`: sep falls by m . n times that.
#pragma once

#include "placed_surface.h"

namespace pbd::reference {

/// Drops such pairs from `first` on, where a's velocity against b leads by `way` (m). What is less than a
/// millionth of the smaller surface is overlooked.
void drop_parted(const PlacedSurface& a, const PlacedSurface& b, const Vec3& way, const Placement& at,
                 std::size_t first, std::vector<FeaturePair>& found);

}  // namespace pbd::reference
