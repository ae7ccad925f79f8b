// How far shapes reach.
#pragma once

#include <Eigen/Geometry>

#include "shapes.h"

namespace pbd {

/// Smallest distance from the frame's origin that no point of the shape exceeds (m); infinite for a half
/// space.
double bounding_radius(const Shape& shape);

/// Radius of what is round of the shape, of a cylinder at most half its length; of a polyhedron half its
/// least width along its principal axes of inertia (m). Goes through the whole surface.
double round_radius(const Shape& shape);

/// A box along the world's axes that holds the shape; infinite for a half space.
Eigen::AlignedBox3d bounds_of(const Shape& shape, const Frame& at);

/// Least of `direction` . x over the shape (m), by a unit vector; minus infinity for a half space.
double least_along(const Shape& shape, const Frame& at, const Vec3& direction);

}  // namespace pbd
