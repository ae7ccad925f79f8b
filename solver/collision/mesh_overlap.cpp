#include "collision/mesh_overlap.h"

#include <cmath>

namespace pbd {
namespace {

/// The least overlap along a face's normal: that face, and the other shape's node that is deepest below it.
struct Overlap {
  int face = -1, node = -1;
  double apart = -infinity;  // m, of the node from the face's plane: negative
};

Vec3 corner(const ClosedMesh& mesh, int triangle, int k) {
  return mesh.surface.x.col(mesh.surface.triangles[triangle][k]);
}

/// That a part of the segment from p to q is below all faces of a convex a by more than `slack` (m).
bool goes_through(const RoundedPolyhedron& a, const Vec3& p, const Vec3& q, double slack) {
  double begin = 0, end = 1;
  for (int f = 0; f < a.face_count(); ++f) {
    const double at_p = a.face_normal(f).dot(p) - a.offset[f] + slack;
    const double at_q = a.face_normal(f).dot(q) - a.offset[f] + slack;
    if (at_p > 0 && at_q > 0) return false;
    if (at_p > 0) begin = std::max(begin, at_p / (at_p - at_q));
    if (at_q > 0) end = std::min(end, at_p / (at_p - at_q));
  }
  return begin < end;
}

struct Corners {
  std::array<Vec3, 3> x;  // m
  const Vec3& normal;     // unit
};

/// That the segment from p to q goes through the triangle, by more than `flush` (m) on both sides and from
/// the lines of its edges: what goes on both sides of one of them is no deeper than it is from that.
bool pierces(const Vec3& p, const Vec3& q, const Corners& triangle, double flush) {
  const auto& [corner, normal] = triangle;
  const Vec3 along = q - p;
  const double begin = normal.dot(p - corner[0]), end = begin + normal.dot(along);
  if (!(std::max(begin, end) > flush && std::min(begin, end) <= -flush)) return false;
  const Vec3 x = p + begin / (begin - end) * along;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 side = corner[(k + 1) % 3] - corner[k], to_x = x - corner[k];
    if (!(normal.cross(side).dot(to_x) > 0)) return false;
    const Vec3 across = along.cross(side);
    if (!(std::abs(across.dot(to_x)) > flush * across.norm())) return false;
  }
  return true;
}

/// That a's edge goes through the mesh's triangle.
bool pierces(const MeshPair& pair, const Polyhedron::Edge& edge, int triangle) {
  const Corners corners{
      {corner(pair.b, triangle, 0), corner(pair.b, triangle, 1), corner(pair.b, triangle, 2)},
      pair.b.solid.faces[triangle].normal};
  return pierces(pair.a.node(edge.node[0]), pair.a.node(edge.node[1]), corners, pair.flush);
}

/// That one of the triangle's edges goes through a convex a, or through its face if it is flat.
bool goes_through_a(const MeshPair& pair, int triangle) {
  const RoundedPolyhedron& a = pair.a;
  const auto cuts = [&](const Vec3& p, const Vec3& q) {
    if (a.face_count() > 2) return goes_through(a, p, q, pair.flush);
    return pierces(p, q, {{a.node(0), a.node(1), a.node(2)}, a.face_normal(0)}, pair.flush);
  };
  for (int k = 0; k < 3; ++k)
    if (cuts(corner(pair.b, triangle, k), corner(pair.b, triangle, (k + 1) % 3))) return true;
  return false;
}

/// A point of a that is inside it: of a mesh one that is known, else the mean of the nodes.
Vec3 inside_of_a(const MeshPair& pair) {
  if (pair.mesh_a != nullptr) return pair.writer.frame_a.place(pair.mesh_a->inside);
  Vec3 middle = Vec3::Zero();
  for (const Vec3& x : pair.a.x) middle += x / static_cast<double>(pair.a.x.size());
  return middle;
}

bool holds_inside_of_a(const MeshPair& pair) {
  MeshPlace place{};
  return nearest_of_mesh(pair.b, inside_of_a(pair), 0, place) && place.distance < -pair.flush;
}

/// Along the normals of the mesh's faces that are cut; of all that are near if the mesh holds a point inside
/// a: of meshes that coincide none is cut. Lists these faces' nodes in the scratch.
Overlap below_mesh(const MeshPair& pair) {
  const RoundedPolyhedron& a = pair.a;
  pair.scratch.cut_nodes.clear();
  AxisBox box;
  for (const Vec3& x : a.x) box.extend(x);
  Overlap least;
  const auto look = [&](int triangle) {
    for (const int i : pair.b.surface.triangles[triangle]) pair.scratch.cut_nodes.push_back(i);
    const Vec3 &normal = pair.b.solid.faces[triangle].normal, on_plane = corner(pair.b, triangle, 0);
    Overlap here{triangle, -1, infinity};
    for (int i = 0; i < a.node_count(); ++i) {
      const double apart = normal.dot(a.node(i) - on_plane);
      if (apart < here.apart) here.node = i, here.apart = apart;
    }
    if (here.apart > least.apart) least = here;
  };
  const bool all = holds_inside_of_a(pair), convex = pair.mesh_a == nullptr && a.face_count() > 0;
  if (all || convex)
    pair.b.tree.find(box, [&](int triangle) {
      if (all || goes_through_a(pair, triangle)) look(triangle);
    });
  for (int e = 0; e < a.edge_count() && !all; ++e) {
    AxisBox of_edge(a.node(a.edge(e).node[0]));
    of_edge.extend(a.node(a.edge(e).node[1]));
    pair.b.tree.find(of_edge, [&](int triangle) {
      if (pierces(pair, a.edge(e), triangle)) look(triangle);
    });
  }
  return least;
}

/// Along the normals of a convex a's faces, of the mesh's nodes in the scratch.
Overlap below_polyhedron(const MeshPair& pair) {
  const RoundedPolyhedron& a = pair.a;
  Overlap least;
  for (int f = 0; f < a.face_count() && pair.mesh_a == nullptr; ++f) {
    Overlap here{f, -1, infinity};
    for (const int i : pair.scratch.cut_nodes) {
      const double apart = a.face_normal(f).dot(pair.b.surface.x.col(i)) - a.offset[f];
      if (apart < here.apart) here.node = i, here.apart = apart;
    }
    if (here.node >= 0 && here.apart > least.apart) least = here;
  }
  return least;
}

}  // namespace

void write_overlap(const MeshPair& pair) {
  const RoundedPolyhedron& a = pair.a;
  if (pair.writer.least() < -std::max(pair.flush, pair.tiny) - a.radius) return;
  const Overlap of_mesh = below_mesh(pair), of_a = below_polyhedron(pair);
  const ContactWriter exchanged = pair.writer.exchanged();
  if (of_a.face >= 0 && of_a.apart > of_mesh.apart)
    exchanged.write(on_face(pair.b.surface.x.col(of_a.node), 0, a.node(a.corner(of_a.face, 0)),
                            a.face_normal(of_a.face), a.radius),
                    exchanged.key(Feature::node, of_a.node, Feature::face, of_a.face), of_a.apart - a.radius);
  else if (of_mesh.face >= 0)
    pair.writer.write(on_face(a.node(of_mesh.node), a.radius, corner(pair.b, of_mesh.face, 0),
                              pair.b.solid.faces[of_mesh.face].normal, 0),
                      pair.writer.key(Feature::node, of_mesh.node, Feature::face, of_mesh.face),
                      of_mesh.apart - a.radius);
}

}  // namespace pbd
