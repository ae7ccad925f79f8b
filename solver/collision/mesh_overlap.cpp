#include "collision/mesh_overlap.h"

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

/// That a part of the segment from p to q is below all faces of a convex a.
bool goes_through(const RoundedPolyhedron& a, const Vec3& p, const Vec3& q) {
  double begin = 0, end = 1;
  for (int f = 0; f < a.face_count(); ++f) {
    const double at_p = a.face_normal(f).dot(p) - a.offset[f];
    const double at_q = a.face_normal(f).dot(q) - a.offset[f];
    if (at_p > 0 && at_q > 0) return false;
    if (at_p > 0) begin = std::max(begin, at_p / (at_p - at_q));
    if (at_q > 0) end = std::min(end, at_p / (at_p - at_q));
  }
  return begin < end;
}

/// That an edge of a goes through the mesh's triangle, or one of its edges through a convex a.
bool cuts(const MeshPair& pair, int triangle) {
  const RoundedPolyhedron& a = pair.a;
  const Vec3 p = corner(pair.b, triangle, 0), q = corner(pair.b, triangle, 1),
             r = corner(pair.b, triangle, 2);
  const auto side = [](const Vec3& u, const Vec3& v, const Vec3& w) { return u.cross(v).dot(w) > 0; };
  for (const auto& edge : a.solid->edges) {
    const Vec3 from = a.node(edge.node[0]), along = a.node(edge.node[1]) - from;
    const Vec3 normal = (q - p).cross(r - p);
    if ((normal.dot(from - p) > 0) == (normal.dot(from + along - p) > 0)) continue;
    const bool left = side(p - from, q - from, along);
    if (left == side(q - from, r - from, along) && left == side(r - from, p - from, along)) return true;
  }
  if (pair.mesh_a != nullptr || a.face_count() == 0) return false;
  return goes_through(a, p, q) || goes_through(a, q, r) || goes_through(a, r, p);
}

/// That the mean of a's nodes is inside the mesh.
bool holds_middle(const MeshPair& pair) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& x : pair.a.x) middle += x / static_cast<double>(pair.a.x.size());
  MeshPlace place{};
  return nearest_of_mesh(pair.b, middle, 0, place) && place.distance < -pair.flush;
}

/// Along the normals of the mesh's faces that are cut, of all that are near where a's middle is inside: none
/// is cut of meshes that coincide. Lists these faces' nodes in the scratch.
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
  const bool all = holds_middle(pair);
  pair.b.tree.find(box, [&](int triangle) {
    if (all || cuts(pair, triangle)) look(triangle);
  });
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
  if (pair.writer.least() <= pair.tiny - a.radius) return;
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
