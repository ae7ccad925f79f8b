// A shape with nodes and edges against a closed mesh, in the mesh's frame: nodes over faces, and edges that
// cross where their distance has a minimum over both surfaces.
#pragma once

#include <algorithm>

#include "collision/scratch.h"
#include "collision/tolerances.h"

namespace pbd {

/// Faces that are level to this angle feel nodes in a flat region: their gaps differ by its cosine, 1e-4
/// (rad).
inline constexpr double flat_slope = 0.014;

/// That the surface rises from its node along the normal, or falls less than by `slope` (sine; of small
/// angles, rad): nodes within a flat region do not feel faces that are oblique to it.
bool lowest_about(const ClosedMesh& mesh, int node, const Vec3& normal, double slope);

/// That the distance does not fall from an edge into its faces, `apart` from the edge to the other shape,
/// when that has turned by `turn` (rad); by no more than half the angle of the faces' normals, beyond which a
/// face is nearer than the edge.
template <class Normal>
bool minimum(const Polyhedron::Edge& edge, const Vec3& along, const Vec3& apart, double turn,
             Normal&& normal) {
  double slope = 0;
  if (turn > 0 && edge.face[0] >= 0 && edge.face[1] >= 0)
    slope = std::min(turn, (normal(edge.face[0]) - normal(edge.face[1])).norm() / 2) * apart.norm();
  for (const std::size_t side : {0U, 1U}) {
    if (edge.face[side] < 0) continue;
    if ((side == 0 ? 1 : -1) * normal(edge.face[side]).cross(along).dot(apart) > slope) return false;
  }
  return true;
}

struct MeshPair {
  const RoundedPolyhedron& a;
  const ClosedMesh& b;
  const ContactWriter& writer;
  CollisionScratch& scratch;
  const ClosedMesh* mesh_a = nullptr;  // if a is one
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
  /// Edges i and j where their distance has a minimum. Inside, the edges' own faces must be the nearest ones
  /// to where they cross.
  void crossing(int i, int j) const;
  void over_faces(const Vec3& y, int node, const ContactWriter& exchanged) const;
  /// The node against a's edge e.
  void beside(const Vec3& y, int node, int e, const ContactWriter& exchanged) const;
};

}  // namespace pbd
