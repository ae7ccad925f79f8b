// Closed meshes against half spaces, against spheres, capsules, boxes and hulls, and against each other:
// nodes over faces, and edges that cross where their distance has a minimum over both surfaces.
#include "contact/mesh_point.h"
#include "contact/pairs.h"
#include "contact/round.h"
#include "contact/segments.h"

namespace pbd {
namespace {

using Index = std::size_t;

Feature feature(MeshPlace::Feature of) {
  if (of == MeshPlace::Feature::face) return Feature::face;
  return of == MeshPlace::Feature::edge ? Feature::edge : Feature::node;
}

/// A sphere about y against a mesh's feature.
void write_place(const Vec3& y, double radius, int i, const ClosedMesh& mesh, const MeshPlace& at,
                 const Roles& roles) {
  const auto key = roles.key(Feature::node, i, feature(at.feature), at.i);
  const double gap = at.distance - radius;
  if (at.feature == MeshPlace::Feature::face)
    return roles.write(on_face(y, radius, at.nearest, at.normal, 0), key, gap);
  if (at.distance > 0 && radius > 0) {
    if (at.feature == MeshPlace::Feature::node)
      return roles.write(features(ContactPoint::Kind::point, y, radius, at.nearest, 0), key, gap);
    const auto& node = mesh.solid.edges[static_cast<Index>(at.i)].node;
    const Vec3 along = (mesh.surface.x.col(node[1]) - mesh.surface.x.col(node[0])).normalized();
    return roles.write(on_line(y, radius, at.nearest, along, 0), key, gap);
  }
  const Vec3 apart = y - at.nearest;
  const Vec3 normal = at.distance != 0 ? Vec3(apart / at.distance) : Vec3(at.normal.normalized());
  roles.write(on_face(y, radius, at.nearest, normal, 0), key, gap);
}

/// That the surface rises from its node along the normal, or falls less than by `slope`: nodes within a flat
/// region do not feel faces that are oblique to it.
bool lowest_about(const ClosedMesh& mesh, int node, const Vec3& normal, double slope) {
  const Vec3 x = mesh.surface.x.col(node);
  bool lowest = true;
  mesh.tree.find(AxisBox(x, x), [&](int triangle) {
    const auto& nodes = mesh.surface.triangles[static_cast<Index>(triangle)];
    if (std::find(nodes.begin(), nodes.end(), node) == nodes.end()) return;
    for (const int other : nodes) {
      const Vec3 to = mesh.surface.x.col(other) - x;
      lowest = lowest && normal.dot(to) >= -slope * to.norm();
    }
  });
  return lowest;
}

constexpr double level = 0.014;  // rad
constexpr double tilted = 0.1;   // rad: of faces whose corners all touch

/// That the distance does not fall from an edge into its faces, `apart` from the edge to the other shape.
template <class Normal>
bool minimum(const Polyhedron::Edge& edge, const Vec3& along, const Vec3& apart, Normal&& normal) {
  for (const Index side : {Index(0), Index(1)}) {
    if (edge.face[side] < 0) continue;
    if ((side == 0 ? 1 : -1) * normal(edge.face[side]).cross(along).dot(apart) > 0) return false;
  }
  return true;
}

/// a, placed in the mesh's frame, against the mesh.
struct Pair {
  const Core& a;
  const ClosedMesh& b;
  const Roles& roles;
  const ClosedMesh* mesh_a = nullptr;  // if a is one
  double limit = roles.margin + a.radius, tiny = rounding * a.size;

  /// Of a mesh, those that are lowest about themselves.
  void nodes() const {
    thread_local std::vector<MeshPlace> minima;
    const auto write = [&](int i, const MeshPlace& at) {
      const Vec3 apart = at.distance != 0 ? Vec3((a.node(i) - at.nearest) / at.distance) : at.normal;
      if (mesh_a == nullptr || lowest_about(*mesh_a, i, roles.a.rotation.transpose() * apart, tilted))
        write_place(a.node(i), a.radius, i, b, at, roles);
    };
    for (int i = 0; i < static_cast<int>(a.x.size()); ++i) {
      MeshPlace nearest{};
      if (!nearest_of_mesh(b, a.node(i), limit, nearest)) continue;
      if (nearest.distance <= 0) {
        write(i, nearest);
      } else {
        minima_of_mesh(b, a.node(i), limit, minima);
        for (const MeshPlace& at : minima) write(i, at);
      }
    }
  }

  void nodes_inside() const {
    for (int i = 0; i < static_cast<int>(a.x.size()); ++i) {
      MeshPlace nearest{};
      if (nearest_of_mesh(b, a.node(i), limit, nearest) && nearest.distance <= 0)
        write_place(a.node(i), a.radius, i, b, nearest, roles);
    }
  }

  bool inside_a(const Vec3& x) const {
    MeshPlace place{};
    if (mesh_a != nullptr)
      return nearest_of_mesh(*mesh_a, roles.a.rotation.transpose() * (x - roles.a.origin), limit, place) &&
             place.distance <= 0;
    for (int f = 0; f < a.face_count(); ++f)
      if (a.face_normal(f).dot(x) > a.offset[static_cast<Index>(f)]) return false;
    return a.face_count() > 0;
  }

  struct Crossing {
    ContactPoint contact;
    std::uint32_t key = 0;
    double gap = -infinity;
  };

  /// Edges i and j where their distance has a minimum. Inside, a's edge must be below the surface that the
  /// normal comes out of; of others that overlap, the `shallowest` is kept.
  void crossing(int i, int j, Crossing& shallowest) const {
    const auto &of_a = a.edge(i), &of_b = b.solid.edges[static_cast<Index>(j)];
    const Vec3 from_b = b.surface.x.col(of_b.node[0]), whole_b = b.surface.x.col(of_b.node[1]) - from_b;
    const double length_b = whole_b.norm();
    const Vec3 along_b = whole_b / length_b;
    const Vec3 &along_a = a.along[static_cast<Index>(i)], &from_a = a.node(of_a.node[0]);
    const double length_a = a.length[static_cast<Index>(i)];
    if (!(length_a > 0)) return;
    const Nearest at = nearest({from_a, along_a, length_a}, {from_b, along_b, length_b});
    if (at.s <= 0 || at.s >= length_a || at.t <= 0 || at.t >= length_b) return;
    const Vec3 y_a = from_a + at.s * along_a, y_b = from_b + at.t * along_b;
    const double distance = at.apart.norm();
    const auto normal_a = [&](int f) -> const Vec3& { return a.face_normal(f); };
    const auto normal_b = [&](int f) -> const Vec3& { return b.solid.faces[static_cast<Index>(f)].normal; };
    const Vec3 outward = normal_b(of_b.face[0]) + normal_b(of_b.face[1]);
    const bool crossed = along_a.cross(along_b).norm() >= crossing_sine;
    if (!crossed && !(distance > 0)) return;
    Vec3 normal = crossed ? Vec3(along_a.cross(along_b).normalized()) : Vec3(at.apart / distance);
    if (normal.dot(outward) < 0) normal = -normal;
    if (!minimum(of_b, along_b, normal, normal_b) || !minimum(of_a, along_a, -normal, normal_a)) return;
    const bool inside = normal.dot(at.apart) < 0;
    bool below = true;
    if (inside) {
      MeshPlace place{};
      const bool in_b = nearest_of_mesh(b, y_a, distance, place) && place.distance <= 0;
      if (!in_b && !inside_a(y_b)) return;
      below = in_b && place.normal.dot(normal) > 0;
    }
    const auto key = roles.key(Feature::edge, i, Feature::edge, j);
    const double gap = (inside ? -distance : distance) - a.radius;
    ContactPoint contact = on_face(y_a, a.radius, y_b, normal, 0);
    if (crossed)
      contact = on_edges(y_a, along_a, a.radius, y_b, along_b, 0, normal);
    else if (a.radius > 0 && !inside)
      contact = on_line(y_a, a.radius, y_b, along_b, 0);
    if (below)
      roles.write(contact, key, gap);
    else if (gap > shallowest.gap)
      shallowest = {contact, key, gap};
  }

  Crossing edges() const {
    Crossing shallowest;
    for (int i = 0; i < a.edge_count(); ++i) {
      AxisBox box;
      for (const int node : a.edge(i).node) box.extend(a.node(node));
      box.min().array() -= limit;
      box.max().array() += limit;
      b.tree.find(box, [&](int triangle) {
        for (Index k = 0; k < 3; ++k)
          crossing(i, b.solid.sides[3 * static_cast<Index>(triangle) + k], shallowest);
      });
    }
    return shallowest;
  }

  /// An edge through a corner, where nothing else overlaps.
  void write_through(const Crossing& crossing) const {
    if (crossing.gap > -infinity && !(roles.least() < -a.radius))
      roles.write(crossing.contact, crossing.key, crossing.gap);
  }

  /// The mesh's face that is cut, and along whose normal a is the least deep, where nothing else overlaps.
  void write_cut() const {
    if (roles.least() < -a.radius) return;
    AxisBox box;
    for (const Vec3& x : a.x) box.extend(x);
    double shallowest = -infinity;
    int cut = -1, node = -1;
    b.tree.find(box, [&](int triangle) {
      if (!cuts(triangle)) return;
      const Vec3& normal = b.solid.faces[static_cast<Index>(triangle)].normal;
      const auto deepest = std::min_element(a.x.begin(), a.x.end(), [&](const Vec3& x, const Vec3& y) {
        return normal.dot(x) < normal.dot(y);
      });
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

  Vec3 corner(int triangle, Index k) const {
    return b.surface.x.col(b.surface.triangles[static_cast<Index>(triangle)][k]);
  }

  /// That an edge of a goes through the triangle, or one of its edges through a convex a.
  bool cuts(int triangle) const {
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

  /// That a part of the segment from p to q is below all faces of a convex a.
  bool goes_through(const Vec3& p, const Vec3& q) const {
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

  /// The mesh's nodes over a's faces or inside a, and beside a's only edge if that has no faces.
  void nodes_of_mesh() const {
    AxisBox box;
    for (const Vec3& x : a.x) box.extend(x);
    box.min().array() -= limit;
    box.max().array() += limit;
    const Roles exchanged = roles.exchanged();
    b.tree.find(box, [&](int triangle) {
      for (const int node : b.surface.triangles[static_cast<Index>(triangle)]) {
        const Vec3 y = b.surface.x.col(node);
        if (!box.contains(y)) continue;
        if (a.face_count() > 0) over_faces(y, node, exchanged);
        for (int e = 0; e < a.edge_count(); ++e) beside(y, node, e, exchanged);
      }
    });
  }

  void over_faces(const Vec3& y, int node, const Roles& exchanged) const {
    int best = -1;
    double apart = -infinity, outside = -infinity;
    for (int f = 0; f < a.face_count(); ++f) {
      const double here = a.face_normal(f).dot(y) - a.offset[static_cast<Index>(f)];
      outside = std::max(outside, here);
      if (here <= apart || !lowest_about(b, node, a.face_normal(f), level)) continue;
      apart = here;
      best = f;
    }
    if (best < 0 || (outside > 0 && (apart < outside || !a.above(best, y, tiny)))) return;
    exchanged.write(on_face(y, 0, a.node(a.corner(best, 0)), a.face_normal(best), a.radius),
                    exchanged.key(Feature::node, node, Feature::face, best), apart - a.radius);
  }

  /// The node against a's edge e.
  void beside(const Vec3& y, int node, int e, const Roles& exchanged) const {
    const Vec3 &along = a.along[static_cast<Index>(e)], &from = a.node(a.edge(e).node[0]);
    const double arc = along.dot(y - from), length = a.length[static_cast<Index>(e)];
    const Vec3 y_a = from + arc * along, apart = y - y_a;
    if (arc <= 0 || arc >= length || apart.dot(b.node_normals.col(node)) >= 0 || apart.norm() >= limit)
      return;
    if (!minimum(a.edge(e), along, apart, [&](int f) -> const Vec3& { return a.face_normal(f); })) return;
    MeshPlace nearest{};  // of the surface, the node must be nearest to the edge's point
    const double distance = apart.norm();
    if (!nearest_of_mesh(b, y_a, distance, nearest) || nearest.distance < distance - tiny) return;
    const auto key = exchanged.key(Feature::node, node, Feature::edge, e);
    if (a.radius > 0)
      exchanged.write(on_line(y, 0, from, along, a.radius), key, distance - a.radius);
    else
      exchanged.write(on_face(y, 0, y_a, apart / distance, 0), key, distance);
  }
};

const Polyhedron segment = [] {
  Polyhedron solid;
  solid.x = (Points(3, 2) << 0, 0, 0, 0, -0.5, 0.5).finished();
  solid.edges.push_back({{0, 1}, {-1, -1}});
  return solid;
}();

/// Of the mesh's edge j, the point nearest to the cylinder, if that is nearest to a rim. True if it is
/// inside.
bool write_edge_beside(const ClosedMesh& mesh, int j, const Round& cylinder, const Roles& roles) {
  const auto& edge = mesh.solid.edges[static_cast<Index>(j)];
  const Vec3 from = mesh.surface.x.col(edge.node[0]), whole = mesh.surface.x.col(edge.node[1]) - from;
  const double length = whole.norm();
  const Vec3 along = whole / length;
  const Segment all{from, along, length};
  const double arc = nearest_arc(all, cylinder);
  const Round::Place at = cylinder.place(all.at(arc));
  if (at.distance <= 0) return true;
  const auto lowest = [&](const Vec3& apart) {
    return minimum(edge, along, -apart,
                   [&](int f) { return mesh.solid.faces[static_cast<Index>(f)].normal; });
  };
  write_where_it_leaves(all, 0, j, cylinder, roles, lowest);
  if (arc > 0 && arc < length && at.part == Round::Part::rim && lowest(at.normal))
    write_point(all.at(arc), 0, Feature::edge, j, cylinder, roles);
  return false;
}

}  // namespace

void cylinder_mesh(const Cylinder& cylinder, const ClosedMesh& b, const Roles& roles) {
  const Round a(cylinder, roles.a);
  thread_local Core axis;
  axis.place(segment, Vec3(1, 1, cylinder.length), cylinder.radius, roles.a);
  const Pair side{axis, b, roles, nullptr};
  const Pair::Crossing through = side.edges();
  side.nodes_of_mesh();
  side.write_through(through);
  const Vec3 reach = a.half * a.axis.cwiseAbs() + Vec3::Constant(a.radius + roles.margin);
  const Roles exchanged = roles.exchanged();
  double shallowest = -infinity;  // of the faces whose edges go through the cylinder
  int cut = -1;
  b.tree.find(AxisBox(a.centre - reach, a.centre + reach), [&](int triangle) {
    const auto& face = b.solid.faces[static_cast<Index>(triangle)];
    const auto& nodes = b.surface.triangles[static_cast<Index>(triangle)];
    const Vec3 on_plane = b.surface.x.col(nodes[0]);
    const double above = face.normal.dot(a.centre - on_plane), support = a.support(face.normal);
    if (above >= 0)
      write_rims(a, on_plane, face.normal, 0, Feature::face, triangle, -support, roles, [&](const Vec3& x) {
        return nearest_of_triangle(b, triangle, x).feature == MeshPlace::Feature::face;
      });
    for (const int node : nodes) {
      const Vec3 y = b.surface.x.col(node);
      const Round::Place at = a.place(y);
      if (at.part != Round::Part::side && lowest_about(b, node, at.normal, level))
        write_point(y, 0, Feature::node, node, a, exchanged);
    }
    for (Index k = 0; k < 3; ++k)
      if (write_edge_beside(b, b.solid.sides[face.first + k], a, exchanged) && above - support > shallowest) {
        shallowest = above - support;
        cut = triangle;
      }
  });
  if (roles.least() <= 0) return;
  MeshPlace place{};
  if (cut >= 0)
    write_deepest_rim(a, b.surface.x.col(b.surface.triangles[static_cast<Index>(cut)][0]),
                      b.solid.faces[static_cast<Index>(cut)].normal, Feature::face, cut, roles);
  else if (nearest_of_mesh(b, a.centre, roles.margin, place) && place.distance <= 0)
    write_deepest_rim(a, place.nearest, place.normal.normalized(), feature(place.feature), place.i, roles);
}

void core_mesh(const Core& a, const ClosedMesh& b, const Roles& roles) {
  const Pair pair{a, b, roles, nullptr};
  pair.nodes();
  const Pair::Crossing through = pair.edges();
  pair.nodes_of_mesh();
  pair.write_through(through);
  pair.write_cut();
}

void mesh_mesh(const Core& a, const ClosedMesh& mesh_a, const Core& b, const ClosedMesh& mesh_b,
               const Roles& in_b, const Roles& in_a) {
  const Pair pair{a, mesh_b, in_b, &mesh_a};
  pair.nodes();
  const Pair::Crossing through = pair.edges();
  const Pair exchanged{b, mesh_a, in_a, &mesh_b};
  exchanged.nodes();
  if (in_b.least() < 0) return;
  pair.nodes_inside();  // overlapping by nodes that are not the lowest ones
  exchanged.nodes_inside();
  pair.write_through(through);
  pair.write_cut();
  exchanged.write_cut();
}

}  // namespace pbd
