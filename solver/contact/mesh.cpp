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

/// a, placed in the mesh's frame, against the mesh.
struct Pair {
  const Core& a;
  const ClosedMesh& b;
  const Roles& roles;
  double limit = roles.margin + a.radius, tiny = rounding * a.size;

  /// Of a surface `of_a`, if a is one, those that are lowest about themselves.
  void nodes(const ClosedMesh* of_a = nullptr) const {
    thread_local std::vector<MeshPlace> minima;
    const auto write = [&](int i, const MeshPlace& at) {
      const Vec3 apart = at.distance != 0 ? Vec3((a.node(i) - at.nearest) / at.distance) : at.normal;
      if (of_a == nullptr || lowest_about(*of_a, i, roles.a.rotation.transpose() * apart, tilted))
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

  /// That the distance does not fall from an edge into its faces, `apart` from the edge to the other's.
  template <class Normal>
  bool minimum(const Polyhedron::Edge& edge, const Vec3& along, const Vec3& apart, Normal&& normal) const {
    for (const Index side : {Index(0), Index(1)}) {
      if (edge.face[side] < 0) continue;
      if ((side == 0 ? 1 : -1) * normal(edge.face[side]).cross(along).dot(apart) > 0) return false;
    }
    return true;
  }

  void crossing(int i, int j) const {
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
    if (inside) {  // a's edge must be inside, below the surface that the normal comes out of
      MeshPlace place{};
      if (!crossed || !nearest_of_mesh(b, y_a, distance, place)) return;
      if (place.distance > 0 || place.normal.dot(normal) <= 0) return;
    }
    const auto key = roles.key(Feature::edge, i, Feature::edge, j);
    const double gap = (inside ? -distance : distance) - a.radius;
    if (crossed)
      roles.write(on_edges(y_a, along_a, a.radius, y_b, along_b, 0, normal), key, gap);
    else if (a.radius > 0)
      roles.write(on_line(y_a, a.radius, y_b, along_b, 0), key, gap);
    else
      roles.write(on_face(y_a, 0, y_b, normal, 0), key, gap);
  }

  void edges() const {
    for (int i = 0; i < a.edge_count(); ++i) {
      AxisBox box;
      for (const int node : a.edge(i).node) box.extend(a.node(node));
      box.min().array() -= limit;
      box.max().array() += limit;
      b.tree.find(box, [&](int triangle) {
        for (Index k = 0; k < 3; ++k) crossing(i, b.solid.sides[3 * static_cast<Index>(triangle) + k]);
      });
    }
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

}  // namespace

void cylinder_mesh(const Cylinder& cylinder, const ClosedMesh& b, const Roles& roles) {
  const Round a(cylinder, roles.a);
  thread_local Core axis;
  axis.place(segment, Vec3(1, 1, cylinder.length), cylinder.radius, roles.a);
  const Pair side{axis, b, roles};
  side.edges();
  side.nodes_of_mesh();
  const Vec3 reach = a.half * a.axis.cwiseAbs() + Vec3::Constant(a.radius + roles.margin);
  const AxisBox box(a.centre - reach, a.centre + reach);
  const double deepest = -std::min(a.radius, a.half);
  const Roles exchanged = roles.exchanged();
  b.tree.find(box, [&](int triangle) {
    const auto& face = b.solid.faces[static_cast<Index>(triangle)];
    const auto& nodes = b.surface.triangles[static_cast<Index>(triangle)];
    write_rims(a, b.surface.x.col(nodes[0]), face.normal, 0, Feature::face, triangle, deepest, roles,
               [&](const Vec3& x) {
                 return nearest_of_triangle(b, triangle, x).feature == MeshPlace::Feature::face;
               });
    for (const int node : nodes) {
      const Vec3 y = b.surface.x.col(node);
      const Round::Place at = a.place(y);
      if (at.part == Round::Part::cap && lowest_about(b, node, at.normal, level))
        write_point(y, 0, Feature::node, node, a, exchanged);
    }
  });
}

void core_mesh(const Core& a, const ClosedMesh& b, const Roles& roles) {
  const Pair pair{a, b, roles};
  pair.nodes();
  pair.edges();
  pair.nodes_of_mesh();
}

void mesh_mesh(const Core& a, const ClosedMesh& mesh_a, const Core& b, const ClosedMesh& mesh_b,
               const Roles& in_b, const Roles& in_a) {
  const Pair pair{a, mesh_b, in_b};
  pair.nodes(&mesh_a);
  pair.edges();
  const Pair exchanged{b, mesh_a, in_a};
  exchanged.nodes(&mesh_b);
  if (in_b.least() < 0) return;
  pair.nodes_inside();  // overlapping by nodes that are not the lowest ones
  exchanged.nodes_inside();
}

}  // namespace pbd
