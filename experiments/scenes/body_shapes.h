// What fills the shapes of rigid bodies, and their surfaces as triangles.
#pragma once

#include <string>

#include "mass_properties.h"
#include "shapes.h"

namespace pbdcheck {

using pbd::Box;
using pbd::Capsule;
using pbd::ClosedMesh;
using pbd::ConvexHull;
using pbd::Cylinder;
using pbd::HalfSpace;
using pbd::Shape;
using pbd::Sphere;

/// Of the shape filled with `density` kg/m^3; throws SetupError for a surface that is inside out.
/// A half space is held by the world and has none.
pbd::MassProperties shape_properties(const Shape& shape, double density);

/// The surface as triangles; round ones are inscribed polyhedra of 32 sides about z, a half space has
/// none.
pbd::TriangleMesh surface_of(const Shape& shape);

/// The convex hull of points, by Qhull; throws SetupError where they lie in a plane.
pbd::TriangleMesh convex_hull(pbd::Points points);
std::string qhull_version();

}  // namespace pbdcheck
