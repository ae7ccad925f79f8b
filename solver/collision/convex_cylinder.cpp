#include "collision/convex_cylinder.h"

#include "collision/cylinder_features.h"
#include "collision/edge_minimum.h"
#include "collision/tolerances.h"

namespace pbd {
namespace {

/// A direction along which polyhedron a is apart from the cylinder (m; negative: they overlap by as much).
struct CylinderAxis {
  enum class Of { face, cap, edge, node };

  double apart = -infinity;
  Of of = Of::cap;
  int i = 0;    // a's face, the cap's end, a's edge or node
  Vec3 normal;  // unit, from the cylinder to a
};

/// Squared sines of edges with the axis: of those without a nearest point of their own (3e-5 rad), and of
/// those that come in and go out over a cap (60 degrees).
constexpr double parallel = 1e-9, across_axis = 0.75;

struct CylinderPair {
  const RoundedPolyhedron& a;
  const PlacedCylinder& b;
  const ContactWriter& writer;
  double limit = writer.reach.margin + a.radius, tiny = rounding * (a.size + b.size());

  double lowest(const Vec3& normal) const {
    double low = infinity;
    for (const Vec3& x : a.x) low = std::min(low, normal.dot(x - b.centre));
    return low;
  }

  CylinderAxis cap_axis() const {
    CylinderAxis best;
    for (const int end : {-1, 1}) {
      const double apart = lowest(end * b.axis) - b.half;
      if (apart > best.apart) best = {apart, CylinderAxis::Of::cap, end, end * b.axis};
    }
    return best;
  }

  CylinderAxis face_axis() const {
    CylinderAxis best;
    for (int f = 0; f < a.face_count(); ++f) {
      const Vec3& normal = a.face_normal(f);
      const double apart = normal.dot(b.centre) - a.offset[f] - b.support(normal);
      if (apart > best.apart) best = {apart, CylinderAxis::Of::face, f, -normal};
    }
    return best;
  }

  /// Normals across the side whose farthest feature of a is the edge or the node they go through.
  void side_axes(CylinderAxis& best) const {
    const auto look = [&](CylinderAxis::Of of, int i, int node, Vec3 normal, double least) {
      if (!(normal.norm() > least)) return;
      normal.normalize();
      for (const int sign : {-1, 1}) {
        const double low = lowest(sign * normal), apart = low - b.radius;
        const bool farthest = sign * normal.dot(a.node(node) - b.centre) <= low + tiny;
        if (farthest && apart > best.apart + tiny) best = {apart, of, i, sign * normal};
      }
    };
    for (int e = 0; e < a.edge_count(); ++e)
      look(CylinderAxis::Of::edge, e, a.edge(e).node[0], a.along[e].cross(b.axis), rounding);
    for (int i = 0; i < a.node_count(); ++i) {
      const Vec3 from = a.node(i) - b.centre;
      look(CylinderAxis::Of::node, i, i, from - from.dot(b.axis) * b.axis, tiny);
    }
  }

  Segment segment(int e) const { return {a.node(a.edge(e).node[0]), a.along[e], a.length[e]}; }

  Vec3 point(int e, double s) const { return a.node(a.edge(e).node[0]) + s * a.along[e]; }

  int end(int e, double s) const {
    if (s <= 0) return a.edge(e).node[0];
    return s >= a.length[e] ? a.edge(e).node[1] : -1;
  }

  bool faces_farther(int e, const Vec3& apart) const {
    return minimum(a.edge(e), a.along[e], -apart, std::max(writer.reach.turn, rounding),
                   [&](int f) -> const Vec3& { return a.face_normal(f); });
  }

  /// The edge's point at arc s against the cylinder's nearest part.
  void write_edge_point(int e, double s) const {
    const Vec3& along = a.along[e];
    const Vec3 y = point(e, s);
    const int node = end(e, s);
    if (node >= 0) return write_point(y, a.radius, Feature::node, node, b, writer);
    const PlacedCylinder::Place at = b.place(y);
    const double gap = at.distance - a.radius;
    if (at.part == PlacedCylinder::Part::side && along.cross(b.axis).norm() >= crossing_sine)
      writer.write(on_edges(y, along, a.radius, b.centre, b.axis, b.radius, at.normal),
                   writer.key(Feature::edge, e, Feature::axis, 0), gap);
    else if (at.part == PlacedCylinder::Part::rim)
      writer.exchanged().write(rim_on_line(b, at.end, at.nearest, y, along, a.radius),
                               writer.key(Feature::edge, e, Feature::rim, at.end + 1), gap);
    else
      write_point(y, a.radius, Feature::edge, e, b, writer);
  }

  /// Edges over the side and where they leave the cylinder's length and the caps' discs.
  void edges(const CylinderAxis& best) const {
    for (int e = 0; e < a.edge_count(); ++e) {
      const Vec3& along = a.along[e];
      const double length = a.length[e], cosine = along.dot(b.axis);
      const Vec3 from = a.node(a.edge(e).node[0]) - b.centre, across = from - from.dot(b.axis) * b.axis,
                 along_across = along - cosine * b.axis;
      const double sine_squared = along_across.squaredNorm();
      const auto inside = [&](double s) { return s > 0 && s < length; };
      write_where_it_leaves(segment(e), a.radius, e, b, writer,
                            [&](const Vec3& apart) { return faces_farther(e, apart); });
      if (!(sine_squared > parallel)) continue;
      const double middle = -across.dot(along_across) / sine_squared;
      const double least_squared = (across + middle * along_across).squaredNorm();
      if (inside(middle)) {
        const Vec3 y = point(e, middle);
        const PlacedCylinder::Place at = b.place(y);
        if (at.part == PlacedCylinder::Part::side && faces_farther(e, at.normal)) write_edge_point(e, middle);
      }
      if (sine_squared < across_axis || least_squared > b.radius * b.radius) continue;
      const double reach = std::sqrt((b.radius * b.radius - least_squared) / sine_squared);
      for (const int sign : {-1, 1}) {
        const double s = middle + sign * reach, z = from.dot(b.axis) + s * cosine,
                     above = std::abs(z) - b.half;
        const int at_end = z < 0 ? -1 : 1;
        const bool deepest =
            best.of == CylinderAxis::Of::cap && best.i == at_end && above >= best.apart - tiny;
        if (!inside(s) || (above < 0 && !deepest)) continue;
        const Vec3 y = point(e, s);
        write_beside_rim(segment(e), a.radius, y, b, at_end, best.apart - a.radius - tiny,
                         writer.key(Feature::edge, e, Feature::cap, crossed_cap(at_end, sign)), writer,
                         [&](const Vec3& apart) { return faces_farther(e, apart); });
      }
    }
  }

  void rims(int f, double floor) const {
    const auto above = [&](const Vec3& x) { return a.above(f, x, tiny); };
    write_rims(b, a.node(a.corner(f, 0)), a.face_normal(f), a.radius, Feature::face, f, floor,
               writer.exchanged(), above, above);
  }

  /// What the best direction says, wherever its features end.
  void write_axis(const CylinderAxis& axis) const {
    const double gap = axis.apart - a.radius;
    if (axis.of == CylinderAxis::Of::face) {
      const ContactPoint contact = on_plane_by_rim(b, b.axis.dot(axis.normal) > 0 ? 1 : -1,
                                                   a.node(a.corner(axis.i, 0)), -axis.normal, a.radius);
      return writer.exchanged().rewrite(contact, writer.key(Feature::face, axis.i, Feature::rim, 0), gap);
    }
    if (axis.of == CylinderAxis::Of::edge)
      return writer.rewrite(on_edges(a.node(a.edge(axis.i).node[0]), a.along[axis.i], a.radius, b.centre,
                                     b.axis, b.radius, axis.normal),
                            writer.key(Feature::edge, axis.i, Feature::axis, 0), gap);
    int deepest = 0;
    for (int i = 1; i < a.node_count(); ++i)
      if (axis.normal.dot(a.node(i)) < axis.normal.dot(a.node(deepest))) deepest = i;
    if (axis.of == CylinderAxis::Of::cap)
      writer.rewrite(on_face(a.node(deepest), a.radius, b.cap(axis.i), axis.normal, 0),
                     writer.key(Feature::node, deepest, Feature::cap, axis.i + 1), gap);
    else
      writer.rewrite(on_line(a.node(deepest), a.radius, b.centre, b.axis, b.radius),
                     writer.key(Feature::node, deepest, Feature::axis, 0), gap);
  }

  /// The edge, or where `arc` is at a node one that meets there, across the rim next to it, along which they
  /// overlap least; false, and nothing is written, where other features lie farther, or the overlap is no
  /// less than `apart` says.
  bool write_across_rim(int edge, double arc, double apart) const {
    const Vec3 y = point(edge, arc), tangent = b.rim_tangent(y);
    const int node = end(edge, arc);
    const int rim = b.end_at(y);
    const Vec3 on_rim = b.rim_at(rim, y);
    CylinderAxis best{apart + tiny, CylinderAxis::Of::edge, -1, {}};
    for (int e = 0; e < a.edge_count(); ++e) {
      const Vec3 across = a.along[e].cross(tangent);
      const bool meets = e == edge || (node >= 0 && (a.edge(e).node[0] == node || a.edge(e).node[1] == node));
      if (!(meets && across.norm() > rounding)) continue;
      const Vec3 normal = (across.dot(y - b.centre) < 0 ? -1 : 1) * across.normalized();
      const double here = lowest(normal) - b.support(normal);
      const bool farthest = std::abs(normal.dot(y - on_rim) - here) <= tiny;  // of both shapes
      if (farthest && here > best.apart) best = {here, CylinderAxis::Of::edge, e, normal};
    }
    if (best.i < 0) return false;
    const double gap = best.apart - a.radius;
    writer.drop_deeper(gap - tiny);
    const Vec3& along = a.along[best.i];
    const auto key = writer.key(Feature::edge, best.i, Feature::rim, rim + 1);
    const ContactPoint contact = rim_on_line(b, rim, on_rim, y, along, a.radius);
    const Touching found = touching(contact, {}, {});
    const double proved = lowest(-found.normal) - b.support(-found.normal) - a.radius;
    if (found.gap >= gap - tiny && std::abs(found.gap - proved) <= tiny)
      writer.exchanged().rewrite(contact, key, found.gap);
    else
      writer.rewrite(on_edges(y, along, a.radius, on_rim, tangent, 0, best.normal), key, gap);
    return true;
  }

  void write() const {
    const CylinderAxis cap = cap_axis(), face = face_axis();
    CylinderAxis best = face.apart > cap.apart ? face : cap;
    if (best.apart >= limit) return;
    if (best.apart <= 0) side_axes(best);
    if (best.apart >= limit) return;
    for (int i = 0; i < a.node_count(); ++i) {
      const PlacedCylinder::Place at = b.place(a.node(i));
      if (at.part == PlacedCylinder::Part::rim || at.distance > limit) continue;
      if (at.distance <= 0 || a.rises_from(i, at.normal, tilted + writer.reach.turn))
        write_point(a.node(i), a.radius, Feature::node, i, b, writer);
    }
    if (face.apart > -infinity) rims(face.i, best.apart - a.radius - tiny);
    edges(best);
    if (writer.least() <= best.apart - a.radius + tiny) return;
    double nearest = infinity, arc = 0;
    int edge = 0;
    for (int e = 0; e < a.edge_count(); ++e) {
      const double s = nearest_arc(segment(e), b);
      const double distance = b.place(point(e, s)).distance;
      if (distance >= nearest) continue;
      nearest = distance;
      edge = e;
      arc = s;
    }
    // Apart if the plane between the nearest points is between the shapes; else a face cuts the cylinder, or
    // the edge a rim.
    const Vec3 y = point(edge, arc), normal = b.place(y).normal;
    const bool apart = nearest > tiny && lowest(normal) - b.support(normal) > tiny;
    if (apart || best.apart > tiny) return write_edge_point(edge, arc);
    if (!write_across_rim(edge, arc, best.apart)) write_axis(best);
  }
};

}  // namespace

void convex_cylinder(const RoundedPolyhedron& a, const Cylinder& cylinder, const ContactWriter& writer) {
  const PlacedCylinder b(cylinder, writer.frame_b);
  CylinderPair{a, b, writer}.write();
}

}  // namespace pbd
