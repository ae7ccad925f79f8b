#include "collision/cylinder_mesh.h"

#include "collision/cylinder_features.h"
#include "collision/edge_minimum.h"
#include "collision/mesh_pair.h"
#include "collision/tolerances.h"

namespace pbd {
namespace {

/// How deep the edge is below the caps or the side, whichever is least, m.
double below_parts(const Segment& edge, const PlacedCylinder& cylinder) {
  const Vec3 from = edge.from - cylinder.centre;
  const double height = cylinder.axis.dot(from), rise = cylinder.axis.dot(edge.along);
  const double other = height + rise * edge.length, low = std::min(height, other),
               high = std::max(height, other);
  const Vec3 across = from - height * cylinder.axis, along = edge.along - rise * cylinder.axis;
  const double bent = along.squaredNorm();
  const double arc = bent > 0 ? std::clamp(-across.dot(along) / bent, 0.0, edge.length) : 0.0;
  return std::min(
      {cylinder.half - low, cylinder.half + high, cylinder.radius - (across + arc * along).norm()});
}

/// Of an edge whose point y is in the cylinder: across it and the rim next to y, if both are lowest along
/// that, and overlap by no more than `most` (m). As lines where they are nearest to each other elsewhere, as
/// in one plane.
template <class Lowest>
bool write_across_rim(const Segment& edge, const Vec3& y, double most, int number,
                      const PlacedCylinder& cylinder, const ContactWriter& writer, Lowest&& lowest) {
  const int end = cylinder.end_at(y);
  const Vec3 tangent = cylinder.rim_tangent(y), on_rim = cylinder.rim_at(end, y);
  Vec3 normal = edge.along.cross(tangent);
  if (!(normal.norm() > rounding)) return false;
  normal = (normal.dot(tangent.cross(cylinder.axis)) < 0 ? -1 : 1) * normal.normalized();
  const double gap = normal.dot(y - on_rim);
  if (end * normal.dot(cylinder.axis) < 0 || -gap > most || !lowest(normal)) return false;
  const auto key = writer.key(Feature::edge, number, Feature::rim, end + 1);
  if (write_beside_rim(edge, 0, y, cylinder, end, -most, key, writer, lowest)) return true;
  const ContactPoint crossing = on_edges(y, edge.along, 0, on_rim, tangent, 0, normal);
  if (!(cylinder.place(touching(crossing, {}, {}).point_a).distance <= rounding * cylinder.size()))
    return false;
  writer.write(crossing, key, gap);
  return true;
}

/// Where an edge that is nearest to a cap leaves it, if it lies across the axis: the edge itself tells
/// nothing of that where it is level. False if nothing is written.
template <class Lowest>
bool write_across_cap(const Segment& edge, const PlacedCylinder::Place& nearest, int number,
                      const PlacedCylinder& cylinder, const ContactWriter& writer, Lowest&& lowest) {
  constexpr double steep = 0.25;  // cosine squared of 60 degrees to the axis
  const Vec3 from = edge.from - cylinder.centre;
  const double cosine = cylinder.axis.dot(edge.along);
  const Vec3 across = from - cylinder.axis.dot(from) * cylinder.axis,
             along = edge.along - cosine * cylinder.axis;
  const double sine_squared = along.squaredNorm(), middle = -across.dot(along) / sine_squared;
  const double left = cylinder.radius * cylinder.radius - (across + middle * along).squaredNorm();
  if (cosine * cosine > steep || !(left > 0)) return false;
  bool any = false;
  for (const int sign : {-1, 1}) {
    const double s = middle + sign * std::sqrt(left / sine_squared);
    if (!(s > 0 && s < edge.length)) continue;
    const auto key = writer.key(Feature::edge, number, Feature::cap, crossed_cap(nearest.end, sign));
    any |= write_beside_rim(edge, 0, edge.at(s), cylinder, nearest.end,
                            nearest.distance - rounding * cylinder.size(), key, writer, lowest);
  }
  return any;
}

/// Of the mesh's edge j, what is nearest to the cylinder, if that is nearest to a cap or a rim. Returns how
/// deep it is inside (m) where no contact tells so.
double write_edge_beside(const ClosedMesh& mesh, int j, const PlacedCylinder& cylinder,
                         const ContactWriter& writer) {
  const auto& edge = mesh.solid.edges[j];
  const Vec3 from = mesh.surface.x.col(edge.node[0]), whole = mesh.surface.x.col(edge.node[1]) - from;
  const double length = whole.norm();
  const Vec3 along = whole / length;
  const Segment all{from, along, length};
  const double arc = nearest_arc(all, cylinder);
  const PlacedCylinder::Place at = cylinder.place(all.at(arc));
  const auto lowest = [&](const Vec3& apart) {
    return minimum(edge, along, -apart, writer.reach.turn, [&](int f) { return mesh.solid.faces[f].normal; });
  };
  // Of a level edge rounding tells whether it is nearest to the cap or, where it leaves that, to the rim or
  // the side.
  const double above_cap = at.end * cylinder.axis.dot(all.at(arc) - cylinder.centre) - cylinder.half;
  const bool at_cap =
      at.part != PlacedCylinder::Part::side || above_cap >= at.distance - rounding * cylinder.size();
  const bool level =
      at_cap && lowest(at.end * cylinder.axis) && write_across_cap(all, at, j, cylinder, writer, lowest);
  if (at.distance <= 0) {
    const double most = below_parts(all, cylinder) + rounding * cylinder.size();
    const bool told = write_across_rim(all, all.at(arc), most, j, cylinder, writer, lowest);
    return told || level ? 0 : -at.distance;
  }
  write_where_it_leaves(all, 0, j, cylinder, writer, lowest);
  if (!level && arc > 0 && arc < length && at.part == PlacedCylinder::Part::rim && lowest(at.normal))
    writer.exchanged().write(rim_on_line(cylinder, at.end, at.nearest, all.at(arc), along, 0),
                             writer.key(Feature::edge, j, Feature::rim, at.end + 1), at.distance);
  return 0;
}

/// True if x is over a face, by `above` (m), or in the mesh with nothing of it nearer: behind a face, x may
/// be beyond the mesh, or go out of it by another face sooner.
bool is_nearest(const ClosedMesh& mesh, const Vec3& x, double above, double slack) {
  MeshPlace place{};
  return above >= 0 || (nearest_of_mesh(mesh, x, slack, place) && above >= place.distance - slack);
}

/// True if the cylinder goes through the triangle and does not end in its plane: then, unless it cuts the
/// triangle's edges, the way from its centre through the plane to its farthest point does.
bool pierces(const PlacedCylinder& cylinder, const ClosedMesh& mesh, int triangle, double above,
             double support) {
  if (!(std::abs(above) < support - rounding * cylinder.size())) return false;
  const Vec3& normal = mesh.solid.faces[triangle].normal;
  const Vec3 farthest = cylinder.farthest((above < 0 ? 1 : -1) * normal);
  const Vec3 through = cylinder.centre + std::abs(above) / support * (farthest - cylinder.centre);
  return nearest_of_triangle(mesh, triangle, through).feature == MeshPlace::Feature::face;
}

}  // namespace

void cylinder_mesh(const Cylinder& cylinder, const ClosedMesh& b, const ContactWriter& writer,
                   CollisionScratch& scratch) {
  const PlacedCylinder a(cylinder, writer.frame_a);
  scratch.a.place(Capsule{cylinder.radius, cylinder.length}, writer.frame_a);
  const MeshPair side{scratch.a, b, writer, scratch, nullptr, true};
  side.edges();
  const Vec3 reach = a.half * a.axis.cwiseAbs() + Vec3::Constant(a.radius + writer.reach.margin);
  const ContactWriter exchanged = writer.exchanged();
  const double tiny = rounding * a.size();
  double shallowest = -infinity;  // m, of the faces that go through the cylinder
  double untold = 0;              // m, how deep their edges are that no contact tells of
  int cut = -1;
  b.tree.find(AxisBox(a.centre - reach, a.centre + reach), [&](int triangle) {
    const auto& face = b.solid.faces[triangle];
    const auto& nodes = b.surface.triangles[triangle];
    const Vec3 on_plane = b.surface.x.col(nodes[0]);
    const double above = face.normal.dot(a.centre - on_plane), support = a.support(face.normal);
    const auto over_face = [&](const Vec3& x) {
      if (nearest_of_triangle(b, triangle, x).feature != MeshPlace::Feature::face) return false;
      return is_nearest(b, x, face.normal.dot(x - on_plane), tiny);
    };
    const auto over_plane = [&](const Vec3& x) {
      const double over = face.normal.dot(x - on_plane);
      MeshPlace place{};
      return nearest_of_mesh(b, x, std::abs(over) + tiny, place) && std::abs(place.distance - over) <= tiny;
    };
    if (above >= 0)
      write_rims(a, on_plane, face.normal, 0, Feature::face, triangle, -support, writer, over_face,
                 over_plane);
    for (const int node : nodes) {
      const Vec3 y = b.surface.x.col(node);
      const PlacedCylinder::Place at = a.place(y);
      if (lowest_about(b, node, at.normal, flat_slope + (at.distance > 0 ? writer.reach.turn : 0)))
        write_point(y, 0, Feature::node, node, a, exchanged);
    }
    bool cuts = pierces(a, b, triangle, above, support);
    for (std::size_t k = 0; k < 3; ++k) {
      const double depth = write_edge_beside(b, b.solid.sides[face.first + k], a, exchanged);
      cuts |= depth >= tiny;
      untold = std::max(untold, depth);
    }
    if (!cuts || above - support <= shallowest) return;
    shallowest = above - support;
    cut = triangle;
  });
  if (writer.least() <= -std::max(tiny, untold / 2)) return;  // another feature tells half of it at least
  MeshPlace place{};
  if (cut >= 0)
    write_deepest_rim(a, b.surface.x.col(b.surface.triangles[cut][0]), b.solid.faces[cut].normal,
                      Feature::face, cut, writer);
  else if (nearest_of_mesh(b, a.centre, writer.reach.margin, place) && place.distance <= 0)
    write_deepest_rim(a, place.nearest, place.normal.normalized(), Feature::axis, 0, writer);  // of no face
}

}  // namespace pbd
