// What touches a cylinder of radius R and length L about the axis u, its middle at c: of a point y with
// z = u . (y - c) and rho = |y - c - z u|
//
//   side   rho - R       where |z| <= L/2
//   cap    |z| - L/2     where rho <= R
//   rim    the distance to the circle, beyond both, of rounded points alone: that of points has no sign
//
// Of what is in the cylinder it is the part that the point was beside where the step begins, or if it was in
// it then, the one that is less deep. The side is across edges, and another's side, as an edge with the
// radius R is (between_surfaces.h). Faces and caps, and a half space, are touched by each rim's deepest
// point, whose way along the rim does not change the gap to first order, and by `rim_corners` of each rim:
// flat on a plane none is deepest, and a rim's own point counts where its disc leans by more than `flat`.
// Edges, sides and other rims are touched by a rim where it is nearest to them (rim_points.h): where an edge
// that lies on a cap leaves it, where discs that lie on each other cross, where a side ends beside an edge.
//
// Limits: a rim and what has no radius must cross: where they are parallel no normal is theirs alone.
#pragma once

#include "between_surfaces.h"

namespace pbd::reference {

/// Appends what corners of another surface touch of a cylinder.
void corners_beside_cylinder(const PlacedSurface& other, const PlacedSurface& cylinder, const Between& both);

/// Appends what rims of either touch of the other's edges, sides and rims.
void rims_across(const PlacedSurface& a, const PlacedSurface& b, const Between& both);

}  // namespace pbd::reference
