// A shape with nodes and edges against a closed mesh, in the mesh's frame: nodes over faces, and edges that
// cross where their distance has a minimum over both surfaces.
#pragma once

#include "contact/mesh_point.h"
#include "contact/pairs.h"

namespace pbd {

inline constexpr double flat_slope = 0.014;  // rad: faces that feel nodes in a flat region

/// That the surface rises from its node along the normal, or falls less than by `slope`: nodes within a flat
/// region do not feel faces that are oblique to it.
bool lowest_about(const ClosedMesh& mesh, int node, const Vec3& normal, double slope);

/// That the distance does not fall from an edge into its faces, `apart` from the edge to the other shape.
template <class Normal>
bool minimum(const Polyhedron::Edge& edge, const Vec3& along, const Vec3& apart, Normal&& normal) {
  for (const std::size_t side : {0U, 1U}) {
    if (edge.face[side] < 0) continue;
    if ((side == 0 ? 1 : -1) * normal(edge.face[side]).cross(along).dot(apart) > 0) return false;
  }
  return true;
}

struct MeshPair {
  const Core& a;
  const ClosedMesh& b;
  const Roles& roles;
  const ClosedMesh* mesh_a = nullptr;  // if a is one
  double limit = roles.margin + a.radius, tiny = rounding * a.size;

  /// Of a mesh, those that are lowest about themselves.
  void nodes() const;
  void nodes_inside() const;
  void edges() const;
  /// The mesh's nodes over a's faces or inside a, and beside a's only edge if that has no faces.
  void nodes_of_mesh() const;
  /// Of the mesh's faces that are cut, and of a's, that along whose normal they overlap least, where nothing
  /// else tells it.
  void write_cut() const;

 private:
  struct Lowest {
    int node = -1;
    double apart = infinity;  // m, from the plane
  };
  Lowest lowest(const Vec3& normal, const Vec3& on_plane) const;
  /// Of x in a (m), if it has a volume: negative outside, and less than -limit where it is farther.
  double depth_in_a(const Vec3& x, double limit_) const;
  /// Edges i and j where their distance has a minimum. Inside, the edges' own faces must be the nearest ones
  /// to where they cross.
  void crossing(int i, int j) const;
  void over_faces(const Vec3& y, int node, const Roles& exchanged) const;
  /// The node against a's edge e.
  void beside(const Vec3& y, int node, int e, const Roles& exchanged) const;
  Vec3 corner(int triangle, std::size_t k) const;
  /// That an edge of a goes through the triangle, or one of its edges through a convex a.
  bool cuts(int triangle) const;
  /// That a part of the segment from p to q is below all faces of a convex a.
  bool goes_through(const Vec3& p, const Vec3& q) const;
};

}  // namespace pbd
