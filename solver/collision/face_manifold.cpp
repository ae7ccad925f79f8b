#include "collision/face_manifold.h"

#include "collision/tolerances.h"

namespace pbd {
namespace {

/// Cosine of how far the normal of edges that cross may be from the face's (0.2 rad): as edges they go on to
/// where these cross once they lie on the face.
constexpr double same_normal = 0.98;

using Corner = ManifoldCorner;

struct Clip {
  const RoundedPolyhedron& a;
  const RoundedPolyhedron& b;
  std::vector<Corner>& polygon;
  std::vector<Corner>& next;

  /// Of the faces about a's deepest node the one that faces b most, or -1.
  int begin(const Vec3& normal) {
    polygon.clear();
    int deepest = 0;
    for (int i = 1; i < a.node_count(); ++i)
      if (normal.dot(a.node(i)) < normal.dot(a.node(deepest))) deepest = i;
    int facing = -1;
    const double slack = rounding * a.size;
    for (int f = 0; f < a.face_count(); ++f)
      if (std::abs(a.face_normal(f).dot(a.node(deepest)) - a.offset[f]) <= slack)
        if (facing < 0 || a.face_normal(f).dot(normal) < a.face_normal(facing).dot(normal)) facing = f;
    if (facing < 0) {
      for (const int node : a.edge(0).node) {
        if (!polygon.empty() && polygon.back().i == node) continue;
        polygon.push_back({a.node(node), Feature::node, node, 0, 0});
      }
    } else {
      for (std::size_t k = 0; k < a.corners(facing); ++k) {
        const int node = a.corner(facing, k);
        polygon.push_back({a.node(node), Feature::node, node, 0, a.side(facing, k)});
      }
    }
    return facing;
  }

  int shared_node(int side, int other, const Vec3& x) const {
    const auto& nodes = b.edge(side).node;
    for (const int node : nodes)
      if (node == b.edge(other).node[0] || node == b.edge(other).node[1]) return node;
    return (b.node(nodes[0]) - x).squaredNorm() < (b.node(nodes[1]) - x).squaredNorm() ? nodes[0] : nodes[1];
  }

  Corner crossing(const Corner& from, double inside, const Corner& to, double outside, int side) const {
    const Vec3 x = from.x + inside / (inside - outside) * (to.x - from.x);
    if (from.to >= 0) return {x, Feature::edge, from.to, side, from.to};
    return {x, Feature::face, 0, shared_node(side, ~from.to, x), from.to};
  }

  /// Keeps what is not more than `slack` outside the side through `corner` with the normal `out`.
  void cut(int side, const Vec3& corner, const Vec3& out, double slack) {
    next.clear();
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Corner& from = polygon[k];
      const Corner& to = polygon[(k + 1) % polygon.size()];
      const double here = out.dot(from.x - corner), there = out.dot(to.x - corner);
      if (here <= slack) next.push_back(from);
      if ((here <= slack) == (there <= slack)) continue;
      next.push_back(crossing(from, here, to, there, side));
      if (here <= slack) next.back().to = ~side;
    }
    std::swap(polygon, next);
  }
};

bool in_span(double arc, double length, double slack) {
  return arc >= -slack && arc <= length + slack;
}

/// What the corners of a clipped polygon are written with.
struct Manifold {
  const RoundedPolyhedron& a;
  const RoundedPolyhedron& b;
  const Vec3& normal;  // of b's face f
  int f, facing;       // a's face that was clipped, or -1
  double radii, slack;
  const ContactWriter& writer;

  ContactPoint on_b(const Vec3& x) const {
    return on_face(x, a.radius, b.node(b.corner(f, 0)), normal, b.radius);
  }

  void write_node(const Corner& corner, double gap) const {
    writer.write(on_b(corner.x), writer.key(Feature::node, corner.i, Feature::face, f), gap);
  }

  /// As a crossing of the edges, if that has the face's normal and is on both of them; else as a point on b.
  void write_crossing(const Corner& corner, double gap) const {
    ContactPoint contact = on_b(corner.x);
    const int i = corner.i, j = corner.j;
    const Vec3& from_a = a.node(a.edge(i).node[0]);
    const Vec3& from_b = b.node(b.edge(j).node[0]);
    const Vec3 cross = a.along[i].cross(b.along[j]);
    double own_gap = gap;
    if (cross.norm() >= crossing_sine && std::abs(cross.dot(normal)) >= same_normal * cross.norm()) {
      const Vec3 apart = from_b - from_a;
      const double cosine = a.along[i].dot(b.along[j]), sine_squared = cross.squaredNorm();
      const double s = apart.dot(a.along[i] - cosine * b.along[j]) / sine_squared;
      const double t = apart.dot(cosine * a.along[i] - b.along[j]) / sine_squared;
      if (in_span(s, a.length[i], slack) && in_span(t, b.length[j], slack)) {
        contact = on_edges(from_a + s * a.along[i], a.along[i], a.radius, from_b + t * b.along[j], b.along[j],
                           b.radius, normal);
        own_gap = (gap + radii) * std::abs(cross.dot(normal)) / cross.norm() - radii;
      }
    }
    writer.write(contact, writer.key(Feature::edge, i, Feature::edge, j), own_gap);
  }

  /// b's node against a's face, if that looks at b and is above the node; else as a point on b.
  void write_node_of_b(const Corner& corner, double gap) const {
    const Vec3& node = b.node(corner.j);
    constexpr double looking = 0.9;  // cosine: the others lie askew, and touch by other features first
    if (facing < 0 || -a.face_normal(facing).dot(normal) < looking || !a.above(facing, node, slack))
      return writer.write(on_b(corner.x),
                          writer.key(facing < 0 ? Feature::edge : Feature::face, std::max(facing, 0),
                                     Feature::node, corner.j),
                          gap);
    const double own_gap = a.face_normal(facing).dot(node) - a.offset[facing];
    const ContactWriter exchanged = writer.exchanged();
    exchanged.write(on_face(node, b.radius, a.node(a.corner(facing, 0)), a.face_normal(facing), a.radius),
                    exchanged.key(Feature::node, corner.j, Feature::face, facing), own_gap - radii);
  }
};

}  // namespace

void face_manifold(const RoundedPolyhedron& a, const RoundedPolyhedron& b, int f, double floor,
                   const ContactWriter& writer, CollisionScratch& scratch) {
  const Vec3& normal = b.face_normal(f);
  const double offset = b.offset[f], radii = a.radius + b.radius;
  const double slack = rounding * (a.size + b.size);
  Clip clip{a, b, scratch.polygon, scratch.clipped};
  const int facing = clip.begin(normal);
  for (std::size_t k = 0; k < b.corners(f) && !scratch.polygon.empty(); ++k) {
    const int side = b.side(f, k);
    const Vec3 along = b.along[side] * (b.edge(side).face[0] == f ? 1.0 : -1.0);
    clip.cut(side, b.node(b.corner(f, k)), along.cross(normal), slack);
  }
  const Manifold manifold{a, b, normal, f, facing, radii, slack, writer};
  for (const Corner& corner : scratch.polygon) {
    const double gap = normal.dot(corner.x) - offset - radii;
    if (!(gap < writer.reach.margin) || gap < floor) continue;
    if (corner.feature == Feature::node)
      manifold.write_node(corner, gap);
    else if (corner.feature == Feature::edge)
      manifold.write_crossing(corner, gap);
    else
      manifold.write_node_of_b(corner, gap);
  }
}

}  // namespace pbd
