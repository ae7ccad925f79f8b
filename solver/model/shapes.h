// Shapes of rigid bodies and of cloth's nodes, each in a frame of its own: about the origin, cylinder and
// capsule along z, a half space below z = 0. A size that is not given is 0, which no body may have.
#pragma once

#include <span>
#include <variant>

#include "box_tree.h"
#include "polyhedron.h"

namespace pbd {

/// Of a node of cloth, the radius may be 0.
struct Sphere {
  double radius = 0;  // m
};
struct Box {
  Vec3 size = Vec3::Zero();  // m
};
struct Cylinder {
  double radius = 0, length = 0;  // m
};
/// `length` is that of the cylindrical part.
struct Capsule {
  double radius = 0, length = 0;  // m
};
/// What is below z = 0; its normal is +z.
struct HalfSpace {};

struct MeshEdge {
  Vec3 along, normal;   // unit; the faces' normals' mean
  double length;        // m
  double cosine, sine;  // of the angle between the faces' normals; of pi where one has none
};

/// A closed surface; its triangles are anticlockwise seen from outside. Throws SetupError for an open one.
struct ClosedMesh {
  explicit ClosedMesh(TriangleMesh closed);

  std::span<const int> neighbours(int node) const {
    const auto first = static_cast<std::size_t>(first_neighbour[node]);
    return std::span(neighbour).subspan(first, static_cast<std::size_t>(first_neighbour[node + 1]) - first);
  }

  TriangleMesh surface;
  AxisBox box;                 // of all points
  double size = 0;             // m, the box's diagonal
  Polyhedron solid;            // a face a triangle
  Points node_normals;         // unit, the faces' normals weighted by their angles at the node
  std::vector<MeshEdge> edge;  // the solid's edges
  std::vector<int> neighbour, first_neighbour;  // nodes that edges lead to from each node
  Vec3 inside;   // m: half way from the middle of the largest triangle to what is behind it
  BoxTree tree;  // of the triangles' boxes
};

/// A closed surface that is convex; likewise.
struct ConvexHull {
  explicit ConvexHull(TriangleMesh convex) : surface(std::move(convex)), solid(plane_faces(surface)) {}

  TriangleMesh surface;
  Polyhedron solid;  // a face a plane
};

/// `monostate`: a body without a shape.
using Shape = std::variant<std::monostate, Sphere, Box, Cylinder, Capsule, ClosedMesh, ConvexHull, HalfSpace>;

}  // namespace pbd
