// Where a shape and a closed mesh overlap without a node or a crossing that tells how deep.
#include "contact/mesh_pair.h"

namespace pbd {

using Index = std::size_t;

void MeshPair::write_through(const Crossing& crossing) const {
  if (crossing.gap > -infinity && !(roles.least() < -a.radius))
    roles.write(crossing.contact, crossing.key, crossing.gap);
}

void MeshPair::write_cut() const {
  if (roles.least() < -a.radius) return;
  AxisBox box;
  for (const Vec3& x : a.x) box.extend(x);
  double shallowest = -infinity;
  int cut = -1, node = -1;
  b.tree.find(box, [&](int triangle) {
    if (!cuts(triangle)) return;
    const Vec3& normal = b.solid.faces[static_cast<Index>(triangle)].normal;
    const auto deepest = std::min_element(
        a.x.begin(), a.x.end(), [&](const Vec3& x, const Vec3& y) { return normal.dot(x) < normal.dot(y); });
    const double apart = normal.dot(*deepest - corner(triangle, 0));
    if (apart <= shallowest) return;
    shallowest = apart;
    cut = triangle;
    node = static_cast<int>(deepest - a.x.begin());
  });
  if (cut < 0) return;
  roles.write(
      on_face(a.node(node), a.radius, corner(cut, 0), b.solid.faces[static_cast<Index>(cut)].normal, 0),
      roles.key(Feature::node, node, Feature::face, cut), shallowest - a.radius);
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
