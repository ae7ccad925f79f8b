// Spheres, capsules, boxes and convex hulls as what is within `radius` of a point, a segment or a convex
// polyhedron, placed in the world (or in a mesh's frame); and closed meshes, which are not convex.
#pragma once

#include <vector>

#include "collision/rounded_triangle.h"
#include "shapes.h"

namespace pbd {

struct RoundedPolyhedron {
  const Polyhedron* solid = nullptr;   // a point or a segment has edges without faces (-1)
  double radius = 0, size = 0;         // m; the core's diameter
  std::vector<Vec3> x, normal, along;  // nodes; unit vectors of
  std::vector<double> offset, length;  // faces and edges; normal . x on a face, edges' lengths (m)

  void place(const Sphere& shape, const Frame& at);
  void place(const Capsule& shape, const Frame& at);
  void place(const Box& shape, const Frame& at);
  void place(const ConvexHull& shape, const Frame& at);
  void place(const ClosedMesh& shape, const Frame& at);  // its edges may be inward ones

  void place(const RoundedTriangle& shape, const Frame& at);

  /// What is within `rounded` of the polyhedron, stretched along its axes, none of whose faces turns.
  void place(const Polyhedron& polyhedron, const Vec3& scale, double rounded, const Frame& at);

  const Vec3& node(int i) const { return x[i]; }
  const Vec3& face_normal(int f) const { return normal[f]; }
  const Polyhedron::Edge& edge(int e) const { return solid->edges[e]; }
  int node_count() const { return static_cast<int>(x.size()); }
  int edge_count() const { return static_cast<int>(solid->edges.size()); }
  int face_count() const { return static_cast<int>(solid->faces.size()); }
  int corner(int f, std::size_t i) const { return solid->corners[solid->faces[f].first + i]; }
  int side(int f, std::size_t i) const { return solid->sides[solid->faces[f].first + i]; }
  std::size_t corners(int f) const { return solid->faces[f].count; }

  /// That the point, moved along the face's normal, is on the face, to `slack` (m).
  bool above(int f, const Vec3& point, double slack) const;

  /// That each edge from the node rises along the normal, or falls less than by `slope` (sine): of a node
  /// that is nearest to what is below.
  bool rises_from(int node, const Vec3& normal, double slope) const;
};

}  // namespace pbd
