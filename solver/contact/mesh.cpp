// Closed meshes against spheres, capsules, boxes and hulls, against cylinders and against each other.
#include "contact/mesh_pair.h"
#include "contact/round.h"

namespace pbd {
namespace {

using Index = std::size_t;

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
  const MeshPair side{axis, b, roles, nullptr};
  side.edges();
  side.nodes_of_mesh();
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
      if (at.part != Round::Part::side && lowest_about(b, node, at.normal, flat_slope))
        write_point(y, 0, Feature::node, node, a, exchanged);
    }
    for (Index k = 0; k < 3; ++k)
      if (write_edge_beside(b, b.solid.sides[face.first + k], a, exchanged) && above - support > shallowest) {
        shallowest = above - support;
        cut = triangle;
      }
  });
  if (roles.least() <= rounding * a.size()) return;
  MeshPlace place{};
  if (cut >= 0)
    write_deepest_rim(a, b.surface.x.col(b.surface.triangles[static_cast<Index>(cut)][0]),
                      b.solid.faces[static_cast<Index>(cut)].normal, Feature::face, cut, roles);
  else if (nearest_of_mesh(b, a.centre, roles.margin, place) && place.distance <= 0)
    write_deepest_rim(a, place.nearest, place.normal.normalized(), Feature::face, -1, roles);
}

void core_mesh(const Core& a, const ClosedMesh& b, const Roles& roles) {
  const MeshPair pair{a, b, roles, nullptr};
  pair.nodes();
  pair.edges();
  pair.nodes_of_mesh();
  pair.write_cut();
}

void mesh_mesh(const Core& a, const ClosedMesh& mesh_a, const Core& b, const ClosedMesh& mesh_b,
               const Roles& in_b, const Roles& in_a) {
  const MeshPair pair{a, mesh_b, in_b, &mesh_a};
  pair.nodes();
  pair.edges();
  const MeshPair exchanged{b, mesh_a, in_a, &mesh_b};
  exchanged.nodes();
  if (in_b.least() < 0) return;
  pair.nodes_inside();  // overlapping by nodes that are not the lowest ones
  exchanged.nodes_inside();
  pair.write_cut();
  exchanged.write_cut();
}

}  // namespace pbd
