// Shapes of rigid bodies, each in a frame of its own: about the origin, cylinder and capsule along z.
#pragma once

#include <string>
#include <variant>

#include "mass_properties.h"
#include "mesh.h"

namespace pbdcheck {

struct Sphere {
  double radius;  // m
};
struct Box {
  pbd::Vec3 size;  // m
};
struct Cylinder {
  double radius, length;  // m
};
/// `length` is that of the cylindrical part.
struct Capsule {
  double radius, length;  // m
};
/// A closed surface, and one that is convex; their triangles are anticlockwise seen from outside.
struct ClosedMesh {
  pbd::TriangleMesh surface;
};
struct Hull {
  pbd::TriangleMesh surface;
};

/// `monostate`: a body without a shape.
using Shape = std::variant<std::monostate, Sphere, Box, Cylinder, Capsule, ClosedMesh, Hull>;

/// Of the shape filled with `density` kg/m^3; throws SetupError for a surface that is open or inside out.
pbd::MassProperties shape_properties(const Shape& shape, double density);

/// The surface as triangles; round ones are inscribed polyhedra of 32 sides about z.
pbd::TriangleMesh surface_of(const Shape& shape);

/// The convex hull of points, by Qhull; throws SetupError where they lie in a plane.
pbd::TriangleMesh convex_hull(pbd::Points points);
std::string qhull_version();

}  // namespace pbdcheck
