// What deformable surfaces pass, or come nearer to than they may, on straight ways.
#include <algorithm>
#include <cmath>

#include "collision/segments.h"
#include "collision/surface_contact.h"

namespace pbd {
namespace {

using Kind = SurfaceContact::Kind;

/// The volume that four nodes span on straight ways: a cubic in the share t of the way, positive where a
/// contact's side is 1 (provot1997collision).
class Volume {
 public:
  Volume(Kind kind, const Points& from, const Points& to) {
    const bool triangle = kind == Kind::node_triangle;
    const auto along = [&](int i, int j) {
      const Vec3 begin = from.col(j) - from.col(i), end = to.col(j) - to.col(i);
      return std::array<Vec3, 2>{begin, end - begin};
    };
    const auto [p, dp] = along(triangle ? 1 : 2, 0);
    const auto [q, dq] = triangle ? along(1, 2) : along(0, 1);
    const auto [r, dr] = triangle ? along(1, 3) : along(2, 3);
    const Vec3 none = q.cross(r), once = q.cross(dr) + dq.cross(r), twice = dq.cross(dr);
    coefficient_ = {p.dot(none), p.dot(once) + dp.dot(none), p.dot(twice) + dp.dot(once), dp.dot(twice)};
  }

  double at(double t) const {
    const auto& [a, b, c, d] = coefficient_;
    return a + t * (b + t * (c + t * d));
  }

  /// visit(t, sign before t) for each share of the way at which the sign changes.
  template <class Visit>
  void each_change(Visit&& visit) const {
    const auto& [a, b, c, d] = coefficient_;
    const std::array<double, 4> bound{a, a + b / 3, a + (2 * b + c) / 3, a + b + c + d};  // of Bernstein's
    const auto [least, most] = std::minmax_element(bound.begin(), bound.end());
    if (*least > 0 || *most < 0) return;
    std::array<double, 4> end{0, 1, 1, 1};  // of parts on which it rises or falls
    std::size_t parts = 1;
    if (const double root = c * c - 3 * b * d; root > 0) {
      const double sum = -(c + std::copysign(std::sqrt(root), c));
      std::array<double, 2> turning{sum / (3 * d), b / sum};
      std::sort(turning.begin(), turning.end());
      for (const double t : turning)
        if (t > 0 && t < 1) end[parts++] = t;
      end[parts] = 1;
    }
    for (std::size_t k = 0; k < parts; ++k) {
      const bool negative = at(end[k]) < 0;
      if (negative != (at(end[k + 1]) < 0)) visit(change(end[k], end[k + 1]), negative ? -1 : 1);
    }
  }

 private:
  double change(double before, double after) const {
    constexpr int halvings = 52;  // of a way: to rounding
    const bool negative = at(before) < 0;
    for (int k = 0; k < halvings; ++k) {
      const double middle = (before + after) / 2;
      ((at(middle) < 0) == negative ? before : after) = middle;
    }
    return after;
  }

  std::array<double, 4> coefficient_{};
};

/// m, between points i to j and k to l of x.
double between(const Points& x, int i, int j, int k, int l) {
  const Vec3 a = x.col(i), b = x.col(k), to_a = x.col(j) - a, to_b = x.col(l) - b;
  const double length_a = to_a.norm(), length_b = to_b.norm();
  const Vec3 along_a = to_a.normalized(), along_b = to_b.normalized();
  return nearest({a, along_a, length_a}, {b, along_b, length_b}).apart.norm();
}

/// m, of a node from a triangle, or of two edges, one of which may be a node.
double distance(const SurfaceContact& contact, const Points& x) {
  if (contact.kind != Kind::node_triangle) return between(x, 0, 1, 2, 3);
  const SurfaceTouching over = touching(contact, x);
  if (on_features(over, contact.kind)) return std::abs(over.gap + contact.thickness);
  return std::min({between(x, 0, 0, 1, 2), between(x, 0, 0, 2, 3), between(x, 0, 0, 3, 1)});
}

/// True if a contact's features have a normal at x, and their nearest points lie on them.
bool meets(const SurfaceContact& contact, const Points& x) {
  const bool triangle = contact.kind == Kind::node_triangle;
  const Vec3 e = triangle ? x.col(2) - x.col(1) : x.col(1) - x.col(0);
  const Vec3 f = triangle ? x.col(3) - x.col(1) : x.col(3) - x.col(2);
  return crossed(e, f) && on_features(touching(contact, x), contact.kind, between_features);
}

/// Sets the side and target of a contact of four nodes on the ways between these columns, if its features
/// pass each other, or overlap where the ways end, by more than where they begin and `slack`.
bool passes(SurfaceContact& contact, const Points& from, const Points& to, double slack, double& target) {
  const Volume volume(contact.kind, from, to);
  int passed = 0;
  Points x(3, 4);
  volume.each_change([&](double t, int before) {
    x = from + t * (to - from);
    if (meets(contact, x)) passed += before;
  });
  const double ends = passed != 0 ? passed : volume.at(1);
  contact.side = ends < 0 ? -1 : 1;
  const SurfaceTouching end = touching(contact, to);
  if (passed == 0 && !(end.gap < -slack && meets(contact, to))) return false;
  target = std::min(0.0, distance(contact, from) - contact.thickness);
  return end.gap < target - slack;
}

}  // namespace

void SurfaceSearch::find_passed(const Points& from, const Points& to, double slack,
                                std::vector<PassedContact>& out) {
  Vec3 course = Vec3::Zero();
  for (const int node : nodes_)
    course += (to.col(node) - from.col(node)) / static_cast<double>(nodes_.size());
  const auto around = [&](const auto& nodes, double margin) {
    AxisBox box;
    for (const int node : nodes) box.extend(Vec3(from.col(node))).extend(Vec3(to.col(node) - course));
    const Vec3 around_box = Vec3::Constant(margin);
    return AxisBox(box.min() - around_box, box.max() + around_box);
  };
  Points begin(3, 4), end(3, 4);
  const auto look = [&](const std::array<int, 4>& nodes, SurfaceContact contact) {
    for (int k = 0; k < 4; ++k) {
      begin.col(k) = from.col(nodes[static_cast<std::size_t>(k)]);
      end.col(k) = to.col(nodes[static_cast<std::size_t>(k)]);
    }
    contact.node = {0, 1, 2, 3};
    PassedContact found{contact};
    if (!passes(found.contact, begin, end, slack, found.target)) return;
    found.contact.node = nodes;
    out.push_back(found);
  };
  each_node_and_triangle(around, [&](const Point& point, const auto& nodes) {
    look(nodes, point.contact(Kind::node_triangle, half_));
  });
  each_pair_of_edges(
      around, [&](const auto& nodes) { look(nodes, {.kind = Kind::edge_edge, .thickness = 2 * half_}); });
  each_node_and_edge(around, [&](const Point& point, int edge) {
    const auto found = beside(point, edge, to, 0);
    if (!found) return;
    const auto [c, d] = ends(edge);
    const double target = std::min(0.0, between(from, point.node, point.node, c, d) - found->thickness);
    if (touching(*found, to).gap < target - slack) out.push_back({*found, target});
  });
}

}  // namespace pbd
