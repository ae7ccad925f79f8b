// Spheres, capsules, boxes and convex hulls as what is within `radius` of a point, a segment or a convex
// polyhedron, placed in the world.
#pragma once

#include <vector>

#include "contact/contact_point.h"
#include "shapes.h"

namespace pbd {

struct Core {
  const Polyhedron* solid = nullptr;   // a point or a segment has edges without faces (-1)
  double radius = 0, size = 0;         // m; the core's diameter
  std::vector<Vec3> x, normal, along;  // nodes; unit vectors of
  std::vector<double> offset, length;  // faces and edges; normal . x on a face, edges' lengths (m)

  /// False for a shape that is none of the four.
  bool place(const Shape& shape, const Frame& at);

  /// What is within `rounded` of the polyhedron, stretched along its axes, none of whose faces turns.
  void place(const Polyhedron& polyhedron, const Vec3& scale, double rounded, const Frame& at);

  const Vec3& node(int i) const { return x[static_cast<std::size_t>(i)]; }
  const Vec3& face_normal(int f) const { return normal[static_cast<std::size_t>(f)]; }
  const Polyhedron::Edge& edge(int e) const { return solid->edges[static_cast<std::size_t>(e)]; }
  int edge_count() const { return static_cast<int>(solid->edges.size()); }
  int face_count() const { return static_cast<int>(solid->faces.size()); }
  int corner(int f, std::size_t i) const {
    return solid->corners[solid->faces[static_cast<std::size_t>(f)].first + i];
  }
  int side(int f, std::size_t i) const {
    return solid->sides[solid->faces[static_cast<std::size_t>(f)].first + i];
  }
  std::size_t corners(int f) const { return solid->faces[static_cast<std::size_t>(f)].count; }

  /// That the point, moved along the face's normal, is on the face, to `slack` (m).
  bool above(int f, const Vec3& point, double slack) const;
};

}  // namespace pbd
