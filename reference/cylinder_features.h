// What touches a cylinder of radius R and length L about the axis u, its middle at c: of a point y with
// z = u . (y - c) and rho = |y - c - z u|
//
//   side   rho - R       where |z| <= L/2
//   cap    |z| - L/2     where rho <= R
//   rim    the distance to the circle, beyond both, of rounded points alone: that of points has no sign
//
// Of what is in the cylinder it is the part that the point was beside where the step begins, or if it was in
// it then, the one that is less deep. A half space is touched by each rim's deepest point, whose way along
// the rim does not change the gap to first order, and by `rim_corners` of each rim: flat on a plane none is
// deepest, and a rim's own point counts where its disc leans by more than `flat`.
//
// Limits: points, spheres and half spaces alone.
#pragma once

#include "placed_surface.h"

namespace pbd::reference {

/// A cylinder and what is beside it, where a step begins and at `at`.
struct BesideCylinder {
  const Placement& start;
  const Placement& at;
  const PlacedSurface& other;
  const PlacedSurface& cylinder;
  double moved = 0;  // m, by both
  double depth = 0;  // m, overlaps that count anyway
};

/// Appends the pairs that are valid at `at`, as near and as deep as FeatureSearch::find says.
void find_beside_cylinder(const BesideCylinder& both, std::vector<FeaturePair>& found);

/// Whether a point (m) is nearer to the axis than the cylinder's radius, but for next to nothing.
bool over_cap(const Surface& cylinder, const Placement& at, const Vec3& point);

/// Throws SetupError if one is a cylinder and the other no point, sphere or half space.
void require_beside_cylinder(const Surface& one, const Surface& other);

}  // namespace pbd::reference
