#include "collision/convex_convex.h"

#include <algorithm>

#include "collision/face_manifold.h"
#include "collision/segments.h"
#include "collision/tolerances.h"

namespace pbd {
namespace {

/// A direction along which a is apart from b (m; negative: they overlap by as much).
struct PolyhedronAxis {
  double apart = -infinity;
  int i = -1, j = -1;  // a face of b (j), or edges of a and b
  Vec3 normal;         // unit, from b to a
};

PolyhedronAxis face_axis(const RoundedPolyhedron& a, const RoundedPolyhedron& b) {
  PolyhedronAxis best;
  for (int f = 0; f < b.face_count(); ++f) {
    const Vec3& normal = b.face_normal(f);
    double lowest = infinity;
    for (const Vec3& x : a.x) lowest = std::min(lowest, normal.dot(x));
    const double apart = lowest - b.offset[f];
    if (apart > best.apart) best = {apart, -1, f, normal};
  }
  return best;
}

/// Faces' normals times edges' directions, row by row of edges.
void slopes(const RoundedPolyhedron& of_edges, const RoundedPolyhedron& of_faces,
            std::vector<double>& table) {
  table.clear();
  for (const Vec3& along : of_edges.along)
    for (const Vec3& normal : of_faces.normal) table.push_back(along.dot(normal));
}

/// Along what is half way between the faces' normals, which of a triangle's edge cancel.
Vec3 outward(const RoundedPolyhedron& core, int e) {
  const Vec3 &first = core.face_normal(core.edge(e).face[0]),
             &second = core.face_normal(core.edge(e).face[1]);
  return first + second + (second - first).cross(core.along[e]);
}

/// Of pairs of edges whose planes of support meet: the arcs between the faces' normals, b's turned round,
/// cross. An edge without faces has the whole circle across it.
PolyhedronAxis edge_axis(const RoundedPolyhedron& a, const RoundedPolyhedron& b, CollisionScratch& scratch) {
  constexpr double parallel = 1e-12;  // squared sine: the product is known to 1e-10 of itself
  std::vector<double>&b_on_a = scratch.slopes_a, &a_on_b = scratch.slopes_b;
  slopes(a, b, b_on_a);
  slopes(b, a, a_on_b);
  const auto at = [](const std::vector<double>& table, int edge, const RoundedPolyhedron& faces, int face) {
    return table[edge * faces.normal.size() + face];
  };
  PolyhedronAxis best;
  for (int i = 0; i < a.edge_count(); ++i)
    for (int j = 0; j < b.edge_count(); ++j) {
      const auto &of_a = a.edge(i).face, &of_b = b.edge(j).face;
      const bool solid_a = of_a[0] >= 0, solid_b = of_b[0] >= 0;
      const double first_b = solid_b ? at(b_on_a, i, b, of_b[0]) : 0;
      if (solid_b && first_b * at(b_on_a, i, b, of_b[1]) >= 0) continue;
      const double first_a = solid_a ? at(a_on_b, j, a, of_a[1]) : 0;
      if (solid_a && first_a * at(a_on_b, j, a, of_a[0]) >= 0) continue;
      if (solid_a && solid_b && first_b * first_a >= 0) continue;
      Vec3 normal = a.along[i].cross(b.along[j]);
      if (!(normal.squaredNorm() > parallel)) continue;
      normal.normalize();
      const Vec3 apart = a.node(a.edge(i).node[0]) - b.node(b.edge(j).node[0]);
      const double outwards = solid_b ? normal.dot(outward(b, j)) : -normal.dot(outward(a, i));
      if (outwards < 0) normal = -normal;
      const double distance = normal.dot(apart);
      if (distance > best.apart) best = {distance, i, j, normal};
    }
  return best;
}

struct PolyhedronPair {
  const RoundedPolyhedron& a;
  const RoundedPolyhedron& b;
  const ContactWriter& writer;
  CollisionScratch& scratch;
  double radii = a.radius + b.radius, limit = writer.reach.margin + radii,
         tiny = rounding * (a.size + b.size);

  Segment segment(const RoundedPolyhedron& core, int e) const {
    return {core.node(core.edge(e).node[0]), core.along[e], core.length[e]};
  }

  bool crossed(int i, int j) const { return a.along[i].cross(b.along[j]).norm() >= crossing_sine; }

  /// The nearest points of edges that are nearer than the limit, along the normal of a plane between a and b.
  bool nearest_edges(const Vec3& normal, int& best_i, int& best_j, Nearest& best) const {
    double top = -infinity, least = limit * limit;
    for (const Vec3& x : b.x) top = std::max(top, normal.dot(x));
    best_i = -1;
    for (int i = 0; i < a.edge_count(); ++i) {
      const Segment of_a = segment(a, i);
      const double low = std::min(normal.dot(of_a.from), normal.dot(of_a.at(of_a.length))) - top;
      if (low > 0 && low * low > least) continue;
      for (int j = 0; j < b.edge_count(); ++j) {
        const Segment of_b = segment(b, j);
        const double high = std::max(normal.dot(of_b.from), normal.dot(of_b.at(of_b.length))) - top;
        if (low > high && (low - high) * (low - high) > least) continue;
        const Nearest found = nearest(of_a, of_b);
        if (!(found.apart.squaredNorm() < least)) continue;
        least = found.apart.squaredNorm();
        best_i = i;
        best_j = j;
        best = found;
      }
    }
    return best_i >= 0;
  }

  /// The end of a's edge i at arc s, or -1.
  int end(const RoundedPolyhedron& core, int e, double s) const {
    if (s <= 0) return core.edge(e).node[0];
    return s >= core.length[e] ? core.edge(e).node[1] : -1;
  }

  /// Points y_a and y_b of edges that are `apart`: kinds whose distance cannot be negative only where the
  /// radii keep it from zero, else the plane between the points. A face's manifold may have the same edges,
  /// which are nearer here.
  void write_edges(int i, int j, const Nearest& at) const {
    const Segment of_a = segment(a, i), of_b = segment(b, j);
    const Vec3 y_a = of_a.at(at.s), y_b = of_b.at(at.t);
    const double distance = at.apart.norm(), gap = distance - radii;
    const int end_a = end(a, i, at.s), end_b = end(b, j, at.t);
    const bool a_ends = end_a >= 0, b_ends = end_b >= 0;
    const auto key = writer.key(a_ends ? Feature::node : Feature::edge, a_ends ? end_a : i,
                                b_ends ? Feature::node : Feature::edge, b_ends ? end_b : j);
    if (!a_ends && !b_ends && crossed(i, j))
      return writer.rewrite(on_edges(y_a, of_a.along, a.radius, y_b, of_b.along, b.radius, at.apart), key,
                            gap);
    if (radii == 0 && distance > 0)
      return writer.rewrite(on_face(y_a, 0, y_b, at.apart / distance, 0), key, gap);
    if (a_ends && b_ends) return writer.rewrite(on_point(y_a, a.radius, y_b, b.radius), key, gap);
    if (b_ends)
      return writer.exchanged().rewrite(on_line(y_b, b.radius, y_a, of_a.along, a.radius), key, gap);
    writer.rewrite(on_line(y_a, a.radius, y_b, of_b.along, b.radius), key, gap);
  }

  /// That no face of the edge is nearer to a point `apart` from it.
  bool nearest_of_faces(const RoundedPolyhedron& core, int e, const Vec3& apart) const {
    const auto& edge = core.edge(e);
    for (const int side : {0, 1}) {
      const int f = edge.face[side];
      if (f < 0) continue;
      const Vec3 inward = core.face_normal(f).cross(core.along[e]) * (side == 0 ? 1 : -1);
      if (inward.dot(apart) > tiny) return false;
    }
    return true;
  }

  /// Where edges are nearly parallel, the ends of one beside the other, too; ends that lie beside each other
  /// once.
  void write_ends(int i, int j) const {
    const Segment of_a = segment(a, i), of_b = segment(b, j);
    // A point has no ends: the nearest points are all of it.
    if (std::min(of_a.length, of_b.length) <= 2 * tiny) return;
    constexpr double nearly_parallel = 0.5;  // sine of 30 degrees
    if (of_a.along.cross(of_b.along).norm() > nearly_parallel) return;
    const auto inside = [&](double arc, const Segment& edge) {
      return std::clamp(arc, tiny, edge.length - tiny);
    };
    for (const double s : {0.0, of_a.length}) {
      const double t = of_b.along.dot(of_a.at(s) - of_b.from);
      const Nearest at{s, inside(t, of_b), of_a.at(s) - of_b.at(t)};
      if (t >= -tiny && t <= of_b.length + tiny && nearest_of_faces(b, j, at.apart)) write_edges(i, j, at);
    }
    for (const double t : {0.0, of_b.length}) {
      const double s = of_a.along.dot(of_b.at(t) - of_a.from);
      const Nearest at{s, t, of_a.at(s) - of_b.at(t)};
      if (s == inside(s, of_a) && nearest_of_faces(a, i, -at.apart)) write_edges(i, j, at);
    }
  }

  /// That the nearest points of two edges are ends of neither.
  bool nearest_inside(const PolyhedronAxis& edges) const {
    const Nearest at = nearest(segment(a, edges.i), segment(b, edges.j));
    return end(a, edges.i, at.s) < 0 && end(b, edges.j, at.t) < 0;
  }

  void write_axis(const PolyhedronAxis& edges) const {
    const Segment of_a = segment(a, edges.i), of_b = segment(b, edges.j);
    const Nearest at = nearest(of_a, of_b);
    const Vec3 y_a = of_a.at(at.s), y_b = of_b.at(at.t);
    // Sharp ones alone: of a rounded triangle, which bends, a plane is its own.
    const bool as_lines = crossed(edges.i, edges.j) || radii > 0;
    writer.write(as_lines ? on_edges(y_a, of_a.along, a.radius, y_b, of_b.along, b.radius, edges.normal)
                          : on_face(y_a, 0, y_b, edges.normal, 0),
                 writer.key(Feature::edge, edges.i, Feature::edge, edges.j), edges.apart - radii);
  }

  /// The deepest node below the face, wherever its sides are.
  void write_deepest(const PolyhedronAxis& flat, bool b_refers) const {
    const RoundedPolyhedron &of_node = b_refers ? a : b, &of_face = b_refers ? b : a;
    const Vec3& normal = of_face.face_normal(flat.j);
    int deepest = 0;
    for (int i = 1; i < of_node.node_count(); ++i)
      if (normal.dot(of_node.node(i)) < normal.dot(of_node.node(deepest))) deepest = i;
    const ContactWriter in_order = b_refers ? writer : writer.exchanged();
    in_order.write(on_face(of_node.node(deepest), of_node.radius, of_face.node(of_face.corner(flat.j, 0)),
                           normal, of_face.radius),
                   in_order.key(Feature::node, deepest, Feature::face, flat.j), flat.apart - radii);
  }

  void write() const {
    const PolyhedronAxis of_b = face_axis(a, b);
    if (of_b.apart > limit) return;
    PolyhedronAxis of_a = face_axis(b, a);
    of_a.normal = -of_a.normal;
    if (of_a.apart > limit) return;
    const bool b_refers = of_b.apart >= of_a.apart - tiny;
    const PolyhedronAxis& flat = b_refers ? of_b : of_a;
    PolyhedronAxis edges;
    if (flat.j >= 0 && flat.apart <= tiny) edges = edge_axis(a, b, scratch);
    if (edges.apart > limit) return;
    const bool across = edges.apart > flat.apart + tiny;
    const PolyhedronAxis& axis = across ? edges : flat;
    if (across && (edges.apart <= tiny || (crossed(edges.i, edges.j) && nearest_inside(edges))))
      write_axis(edges);
    if (flat.j >= 0) {
      const double floor = axis.apart - radii - tiny;
      if (b_refers)
        face_manifold(a, b, flat.j, floor, writer, scratch);
      else
        face_manifold(b, a, flat.j, floor, writer.exchanged(), scratch);
    }
    if (axis.j >= 0 && writer.least() <= axis.apart - radii + tiny) return;
    // Points that coincide have no direction: what touches an edge or a node does so on the best plane.
    if (axis.j >= 0 && axis.apart <= tiny) return write_deepest(flat, b_refers);
    int i = 0, j = 0;
    Nearest at{};
    if (!nearest_edges(axis.j >= 0 ? axis.normal : Vec3::Zero(), i, j, at)) return;
    write_ends(i, j);
    if (at.apart.norm() - radii < writer.least() - tiny) write_edges(i, j, at);
  }
};

}  // namespace

void convex_convex(const RoundedPolyhedron& a, const RoundedPolyhedron& b, const ContactWriter& writer,
                   CollisionScratch& scratch) {
  PolyhedronPair{a, b, writer, scratch}.write();
}

}  // namespace pbd
