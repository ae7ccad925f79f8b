// Cylinders against spheres, capsules, boxes and hulls.
#include "contact/pairs.h"
#include "contact/round.h"
#include "contact/segments.h"

namespace pbd {
namespace {

using Index = std::size_t;

/// A direction along which core a is apart from the cylinder (m; negative: they overlap by as much).
struct Axis {
  enum class Of { face, cap, edge, node };

  double apart = -infinity;
  Of of = Of::cap;
  int i = 0;    // a's face, the cap's end, a's edge or node
  Vec3 normal;  // unit, from the cylinder to a
};

struct Pair {
  const Core& a;
  const Round& b;
  const Roles& roles;
  double limit = roles.margin + a.radius, tiny = rounding * (a.size + b.size());

  double lowest(const Vec3& normal) const {
    double low = infinity;
    for (const Vec3& x : a.x) low = std::min(low, normal.dot(x - b.centre));
    return low;
  }

  Axis flat_axis() const {
    Axis best;
    for (const int end : {-1, 1}) {
      const double apart = lowest(end * b.axis) - b.half;
      if (apart > best.apart) best = {apart, Axis::Of::cap, end, end * b.axis};
    }
    for (int f = 0; f < a.face_count(); ++f) {
      const Vec3& normal = a.face_normal(f);
      const double apart = normal.dot(b.centre) - a.offset[static_cast<Index>(f)] - b.support(normal);
      if (apart > best.apart) best = {apart, Axis::Of::face, f, -normal};
    }
    return best;
  }

  /// Normals across the side through edges and nodes of a.
  void side_axes(Axis& best) const {
    const auto look = [&](Axis::Of of, int i, Vec3 normal) {
      if (!(normal.norm() > rounding)) return;
      normal.normalize();
      for (const int sign : {-1, 1}) {
        const double apart = lowest(sign * normal) - b.radius;
        if (apart > best.apart + tiny) best = {apart, of, i, sign * normal};
      }
    };
    for (int e = 0; e < a.edge_count(); ++e)
      look(Axis::Of::edge, e, a.along[static_cast<Index>(e)].cross(b.axis));
    for (int i = 0; i < static_cast<int>(a.x.size()); ++i) {
      const Vec3 from = a.node(i) - b.centre;
      look(Axis::Of::node, i, from - from.dot(b.axis) * b.axis);
    }
  }

  int end(int e, double s) const {
    if (s <= 0) return a.edge(e).node[0];
    return s >= a.length[static_cast<Index>(e)] ? a.edge(e).node[1] : -1;
  }

  bool faces_farther(int e, const Vec3& apart) const {
    for (const Index side : {Index(0), Index(1)}) {
      const int f = a.edge(e).face[side];
      if (f < 0) continue;
      const Vec3 inward = a.face_normal(f).cross(a.along[static_cast<Index>(e)]) * (side == 0 ? 1 : -1);
      if (inward.dot(apart) < -tiny) return false;
    }
    return true;
  }

  /// The edge's point at arc s against the cylinder's nearest part.
  void write_edge_point(int e, double s) const {
    const Vec3& along = a.along[static_cast<Index>(e)];
    const Vec3 y = a.node(a.edge(e).node[0]) + s * along;
    const int node = end(e, s);
    if (node >= 0) return write_point(y, a.radius, Feature::node, node, b, roles);
    const Round::Place at = b.place(y);
    const double gap = at.distance - a.radius;
    if (at.part == Round::Part::side && along.cross(b.axis).norm() >= crossing_sine)
      roles.write(on_edges(y, along, a.radius, b.centre, b.axis, b.radius, at.normal),
                  roles.key(Feature::edge, e, Feature::axis, 0), gap);
    else if (at.part == Round::Part::rim && a.radius > 0)
      roles.exchanged().write(on_line(at.nearest, 0, y, along, a.radius),
                              roles.key(Feature::edge, e, Feature::rim, at.end + 1), gap);
    else
      write_point(y, a.radius, Feature::edge, e, b, roles);
  }

  /// Edges over the side and where they leave the cylinder's length and the caps' discs.
  void edges(const Axis& best) const {
    for (int e = 0; e < a.edge_count(); ++e) {
      const Vec3& along = a.along[static_cast<Index>(e)];
      const double length = a.length[static_cast<Index>(e)], cosine = along.dot(b.axis);
      const Vec3 from = a.node(a.edge(e).node[0]) - b.centre, across = from - from.dot(b.axis) * b.axis,
                 along_across = along - cosine * b.axis;
      const double sine_squared = along_across.squaredNorm();
      const auto inside = [&](double s) { return s > 0 && s < length; };
      if (sine_squared < 0.25 && std::abs(cosine) > 0)
        for (const int at_end : {-1, 1}) {
          const double s = (at_end * b.half - from.dot(b.axis)) / cosine;
          if (!inside(s)) continue;
          const Vec3 y = a.node(a.edge(e).node[0]) + s * along;
          const double outside = (y - b.cap(at_end)).norm() - b.radius;
          if (outside >= 0 && faces_farther(e, y - b.cap(at_end)))
            roles.write(on_line(y, a.radius, b.centre, b.axis, b.radius),
                        roles.key(Feature::edge, e, Feature::rim, 2 * at_end + 4), outside - a.radius);
        }
      if (!(sine_squared > rounding)) continue;
      const double middle = -across.dot(along_across) / sine_squared;
      const double least_squared = (across + middle * along_across).squaredNorm();
      if (inside(middle)) {
        const Vec3 y = a.node(a.edge(e).node[0]) + middle * along;
        const Round::Place at = b.place(y);
        if (at.part == Round::Part::side && faces_farther(e, at.normal)) write_edge_point(e, middle);
      }
      if (sine_squared < 0.75 || least_squared > b.radius * b.radius) continue;
      const double reach = std::sqrt((b.radius * b.radius - least_squared) / sine_squared);
      for (const int sign : {-1, 1}) {
        const double s = middle + sign * reach, z = from.dot(b.axis) + s * cosine,
                     above = std::abs(z) - b.half;
        const int at_end = z < 0 ? -1 : 1;
        const bool deepest = best.of == Axis::Of::cap && best.i == at_end && above >= best.apart - tiny;
        if (!inside(s) || (above < 0 && !deepest)) continue;
        const Vec3 y = a.node(a.edge(e).node[0]) + s * along;
        roles.write(on_face(y, a.radius, b.cap(at_end), at_end * b.axis, 0),
                    roles.key(Feature::edge, e, Feature::cap, 10 + 2 * at_end + sign), above - a.radius);
      }
    }
  }

  /// The arc of an edge's point nearest to the cylinder: the distance is convex, its slope is bisected.
  double nearest_arc(int e) const {
    const Vec3 &from = a.node(a.edge(e).node[0]), &along = a.along[static_cast<Index>(e)];
    const auto slope = [&](double s) {
      const Round::Place at = b.place(from + s * along);
      return at.distance > 0 ? along.dot(at.normal) : 0.0;
    };
    double low = 0, high = a.length[static_cast<Index>(e)];
    if (slope(low) >= 0) return low;
    if (slope(high) <= 0) return high;
    constexpr int halvings = 60;
    for (int k = 0; k < halvings; ++k) {
      const double middle = (low + high) / 2, here = slope(middle);
      if (here == 0) return middle;
      (here < 0 ? low : high) = middle;
    }
    return (low + high) / 2;
  }

  double least() const {
    double gap = infinity;
    for (std::size_t i = roles.begin; i < roles.out.size(); ++i) {
      const bool same = roles.out[i].swapped == roles.swapped;
      gap = std::min(gap, touching(roles.out[i], same ? roles.a : roles.b, same ? roles.b : roles.a).gap);
    }
    return gap;
  }

  void rims(int f, double floor) const {
    write_rims(b, a.node(a.corner(f, 0)), a.face_normal(f), a.radius, Feature::face, f, floor,
               roles.exchanged(), [&](const Vec3& x) { return a.above(f, x, tiny); });
  }

  /// What the best direction says, wherever its features end.
  void write_axis(const Axis& axis) const {
    if (axis.of == Axis::Of::face) {
      const Roles exchanged = roles.exchanged();
      ContactPoint contact = on_face(b.cap(b.axis.dot(axis.normal) > 0 ? 1 : -1), 0,
                                     a.node(a.corner(axis.i, 0)), -axis.normal, a.radius);
      contact.direction_a = b.axis;
      contact.rim_a = b.radius;
      return exchanged.write(contact, exchanged.key(Feature::rim, 0, Feature::face, axis.i),
                             axis.apart - a.radius);
    }
    if (axis.of == Axis::Of::edge)
      return roles.write(on_edges(a.node(a.edge(axis.i).node[0]), a.along[static_cast<Index>(axis.i)],
                                  a.radius, b.centre, b.axis, b.radius, axis.normal),
                         roles.key(Feature::edge, axis.i, Feature::axis, 0), axis.apart - a.radius);
    int deepest = 0;
    for (int i = 1; i < static_cast<int>(a.x.size()); ++i)
      if (axis.normal.dot(a.node(i)) < axis.normal.dot(a.node(deepest))) deepest = i;
    const bool cap = axis.of == Axis::Of::cap;
    roles.write(cap ? on_face(a.node(deepest), a.radius, b.cap(axis.i), axis.normal, 0)
                    : on_line(a.node(deepest), a.radius, b.centre, b.axis, b.radius),
                roles.key(Feature::node, deepest, cap ? Feature::cap : Feature::axis, cap ? axis.i + 1 : 0),
                axis.apart - a.radius);
  }

  void write() const {
    const Axis flat = flat_axis();
    if (flat.apart >= limit) return;
    Axis best = flat;
    if (flat.apart <= 0) side_axes(best);
    if (best.apart >= limit) return;
    for (int i = 0; i < static_cast<int>(a.x.size()); ++i) {
      const auto part = b.place(a.node(i)).part;
      if (part != Round::Part::rim) write_point(a.node(i), a.radius, Feature::node, i, b, roles);
    }
    if (flat.of == Axis::Of::face) rims(flat.i, best.apart - a.radius - tiny);
    edges(best);
    if (least() <= best.apart - a.radius + tiny) return;
    double nearest = infinity, arc = 0;
    int edge = 0;
    for (int e = 0; e < a.edge_count(); ++e) {
      const double s = nearest_arc(e);
      const double distance =
          b.place(a.node(a.edge(e).node[0]) + s * a.along[static_cast<Index>(e)]).distance;
      if (distance >= nearest) continue;
      nearest = distance;
      edge = e;
      arc = s;
    }
    if (nearest > tiny)
      write_edge_point(edge, arc);
    else if (best.apart <= tiny)
      write_axis(best);
  }
};

}  // namespace

void cylinder_core(const Core& a, const Cylinder& cylinder, const Roles& roles) {
  const Round b(cylinder, roles.b);
  Pair{a, b, roles}.write();
}

}  // namespace pbd
