// A shape with nodes and edges against a closed mesh, in the mesh's frame: nodes over faces, and edges that
// cross where their distance has a minimum over both surfaces.
#pragma once

#include "collision/scratch.h"
#include "collision/tolerances.h"

namespace pbd {

/// Faces that are level to this angle feel nodes in a flat region: their gaps differ by its cosine, 1e-4
/// (rad).
inline constexpr double flat_slope = 0.014;

/// That the surface rises from its node along the normal, or falls less than by `slope` (sine; of small
/// angles, rad): nodes within a flat region do not feel faces that are oblique to it.
bool lowest_about(const ClosedMesh& mesh, int node, const Vec3& normal, double slope);

struct MeshPair {
  const RoundedPolyhedron& a;
  const ClosedMesh& b;
  const ContactWriter& writer;
  CollisionScratch& scratch;
  const ClosedMesh* mesh_a = nullptr;  // if a is one
  bool flat_ends = false;              // a is the side of a cylinder
  double limit = writer.reach.margin + a.radius, tiny = rounding * a.size, turn = writer.reach.turn;
  double flush = (a.radius > 0 ? 0 : flush_part) * a.size;  // m: nodes so near lie on the mesh

  /// Of a mesh, those that are lowest about themselves.
  void nodes() const;
  /// Those that are deeper in the mesh than what lies on it.
  void nodes_inside() const;
  void edges() const;
  /// The mesh's nodes over a's faces or inside a, and beside a's only edge if that has no faces.
  void nodes_of_mesh() const;

 private:
  /// Of x in a (m), if it has a volume: negative outside, and less than -farthest where it is farther.
  double depth_in_a(const Vec3& x, double farthest) const;
  /// That a's surface rises from its node along a normal of the mesh.
  bool lies_above(int node, const Vec3& normal) const;
  /// Writes a node that is on the mesh, on the face that a lies above; false if there is none.
  bool write_flush(int node) const;
  /// Edges i and j where their distance has a minimum; at a node of either where they touch there: nodes that
  /// are apart `beside` and `nodes` tell of. About a convex node both surfaces then part from it; at a saddle
  /// each of its edges that another one lies across holds for itself. Inside, the edges' own faces must be
  /// the nearest ones to where they cross.
  void crossing(int i, int j) const;
  /// True if edges i and j are no minimum however they lie, `normal` the mean of those of a's faces: that of
  /// a minimum is off an edge's own by no more than the angle of its faces' normals (edge_minimum.h).
  bool look_away(int i, const Vec3& normal, int j) const;
  void over_faces(const Vec3& y, int node, const ContactWriter& exchanged) const;
  /// The node against a's edge e.
  void beside(const Vec3& y, int node, int e, const ContactWriter& exchanged) const;
};

}  // namespace pbd
