// Where a shape and a closed mesh overlap without a node or a crossing that tells how deep.
#include "contact/mesh_pair.h"

namespace pbd {

using Index = std::size_t;

void MeshPair::write_cut() const {
  if (roles.least() <= tiny - a.radius) return;
  thread_local std::vector<int> cut_nodes;
  cut_nodes.clear();
  AxisBox box;
  for (const Vec3& x : a.x) box.extend(x);
  double shallowest = -infinity;
  int cut = -1, node = -1, face = -1;
  b.tree.find(box, [&](int triangle) {
    if (!cuts(triangle)) return;
    for (const int i : b.surface.triangles[static_cast<Index>(triangle)]) cut_nodes.push_back(i);
    const Vec3& normal = b.solid.faces[static_cast<Index>(triangle)].normal;
    const auto [deepest, apart] = lowest(normal, corner(triangle, 0));
    if (apart <= shallowest) return;
    shallowest = apart;
    cut = triangle;
    node = deepest;
  });
  for (int f = 0; f < a.face_count() && mesh_a == nullptr; ++f) {
    int deepest = -1;
    double apart = infinity;
    for (const int i : cut_nodes) {
      const double here = a.face_normal(f).dot(b.surface.x.col(i)) - a.offset[static_cast<Index>(f)];
      if (here >= apart) continue;
      apart = here;
      deepest = i;
    }
    if (deepest < 0 || apart <= shallowest) continue;
    shallowest = apart;
    face = f;
    node = deepest;
  }
  const Roles exchanged = roles.exchanged();
  if (face >= 0)
    exchanged.write(
        on_face(b.surface.x.col(node), 0, a.node(a.corner(face, 0)), a.face_normal(face), a.radius),
        exchanged.key(Feature::node, node, Feature::face, face), shallowest - a.radius);
  else if (cut >= 0)
    roles.write(
        on_face(a.node(node), a.radius, corner(cut, 0), b.solid.faces[static_cast<Index>(cut)].normal, 0),
        roles.key(Feature::node, node, Feature::face, cut), shallowest - a.radius);
}

MeshPair::Lowest MeshPair::lowest(const Vec3& normal, const Vec3& on_plane) const {
  Lowest found;
  for (int i = 0; i < static_cast<int>(a.x.size()); ++i) {
    const double here = normal.dot(a.node(i) - on_plane);
    if (here < found.apart) found = {i, here};
  }
  return found;
}

Vec3 MeshPair::corner(int triangle, Index k) const {
  return b.surface.x.col(b.surface.triangles[static_cast<Index>(triangle)][k]);
}

bool MeshPair::cuts(int triangle) const {
  const Vec3 p = corner(triangle, 0), q = corner(triangle, 1), r = corner(triangle, 2);
  const auto side = [](const Vec3& u, const Vec3& v, const Vec3& w) { return u.cross(v).dot(w) > 0; };
  for (const auto& edge : a.solid->edges) {
    const Vec3 from = a.node(edge.node[0]), along = a.node(edge.node[1]) - from;
    const Vec3 normal = (q - p).cross(r - p);
    if ((normal.dot(from - p) > 0) == (normal.dot(from + along - p) > 0)) continue;
    const bool left = side(p - from, q - from, along);
    if (left == side(q - from, r - from, along) && left == side(r - from, p - from, along)) return true;
  }
  if (mesh_a != nullptr || a.face_count() == 0) return false;
  return goes_through(p, q) || goes_through(q, r) || goes_through(r, p);
}

bool MeshPair::goes_through(const Vec3& p, const Vec3& q) const {
  double begin = 0, end = 1;
  for (int f = 0; f < a.face_count(); ++f) {
    const double at_p = a.face_normal(f).dot(p) - a.offset[static_cast<Index>(f)];
    const double at_q = a.face_normal(f).dot(q) - a.offset[static_cast<Index>(f)];
    if (at_p > 0 && at_q > 0) return false;
    if (at_p > 0) begin = std::max(begin, at_p / (at_p - at_q));
    if (at_q > 0) end = std::min(end, at_p / (at_p - at_q));
  }
  return begin < end;
}

}  // namespace pbd
