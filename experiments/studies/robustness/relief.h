// Flat and rugged blocks as meshes, and what is pointed.
#pragma once

#include "shapes.h"

namespace pbdcheck {

/// A block of `size` (m) about the origin, its top cut into cells x cells squares of two triangles.
pbd::ClosedMesh plate(int cells, const pbd::Vec3& size);

inline constexpr double relief = 0.3;  // m, of what rises from a block or is cut into it

/// A cube of 1 m with a spike (-1: a hole) or a ridge (a groove) along y at the middle of its top; it slopes
/// over `slope` (m).
pbd::ClosedMesh with_relief(bool along, double sign);
inline constexpr double slope = 0.25;

/// A pyramid of 0.2 x 0.2 m, or a wedge with its edge along y, `depth` (m) down to its point, about its
/// centre.
pbd::ConvexHull pointed(bool wedge, double depth);

}  // namespace pbdcheck
