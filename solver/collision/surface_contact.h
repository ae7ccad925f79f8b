// Contact of deformable surfaces with each other and with spheres about nodes: a node against a triangle or
// an edge, or an edge against an edge. With
// weights w that sum to zero, one a node, gap = n . sum_k w_k x_k - thickness, and its derivative by x_k is
// w_k n^T:
//   node 0 against triangle 1 2 3   n = +- (x2 - x1) x (x3 - x1) normalised, w = (1, -b1, -b2, -b3), b the
//                                   barycentric coordinates of x0's projection
//   edge 0 1 against edge 2 3       n = +- (x1 - x0) x (x3 - x2) normalised, w = (1 - s, s, t - 1, -t) of the
//                                   nearest points of the two lines
//   node 0 against edge 2 3         n from the edge's nearest point to x0, w = (1, 0, t - 1, -t); where the
//                                   surface ends or is folded, its triangles away from the node; the nearest
//                                   point may be an end, which is how nodes touch nodes
//   sphere 0 against sphere 2       the same of an edge without length, nodes 2 and 3 being one, w = (1, 0,
//                                   -1, 0), the thickness the sum of their radii
// The sign keeps the side on which the step begins. A node and an edge have none: a node that comes out on
// the other side within one step, by more than the thickness, goes through.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "box_tree.h"
#include "geometry.h"

namespace pbd {

struct SurfaceContact {
  enum class Kind : std::uint8_t { node_triangle, edge_edge, node_edge };

  std::array<int, 4> node{};  // of a node and an edge the node twice
  Kind kind = Kind::node_triangle;
  double side = 1;
  Vec3 toward = Vec3::Zero();  // of a node and an edge, n where the node is on it
  double thickness = 0;        // m, at which they touch
  double radius = 0;           // m, of a sphere about node 0

  std::pair<Kind, std::array<int, 4>> features() const { return {kind, node}; }
  bool same_features(const SurfaceContact& other) const { return features() == other.features(); }
  bool of_spheres() const { return kind == Kind::node_edge && node[2] == node[3]; }
};

struct SurfaceTouching {
  double gap = 0;  // m
  Vec3 normal = Vec3::UnitZ();
  Eigen::Vector4d weight = Eigen::Vector4d::Zero();
  Vec3 point = Vec3::Zero();  // m, of the side with positive weights
};

SurfaceTouching touching(const SurfaceContact& contact, const Points& x);

/// Of a feature: what lies between two that meet is on both.
inline constexpr double between_features = 1e-9;

/// True of directions that span a plane: their product is more than rounding.
bool crossed(const Vec3& e, const Vec3& f);

/// True if the nearest points lie on the features, or no farther `beside` them than that share of them.
bool on_features(const SurfaceTouching& touching, SurfaceContact::Kind kind, double beside = 0);

/// A node that is a sphere, of no triangle. It touches no triangle with one of the nodes that it is `kept`
/// from, ascending.
struct NodeSphere {
  int node = 0;
  double radius = 0;  // m
  std::vector<int> kept{};
};

/// What came to overlap on a way, with the gap that is asked for, m.
struct PassedContact {
  SurfaceContact contact;
  double target = 0;
};

/// Finds what may touch: surfaces each other and themselves at a distance of `thickness`, if they `touch` at
/// all, and spheres surfaces at half of it. Keeps triangles' edges and scratch from step to step.
class SurfaceSearch {
 public:
  SurfaceSearch(const std::vector<std::array<int, 3>>& triangles, double thickness, bool touch = true,
                const std::vector<NodeSphere>& spheres = {});

  /// Of triangles and spheres.
  const std::vector<int>& nodes() const { return nodes_; }
  /// False where nothing is looked for.
  bool searches() const { return !points_.empty(); }

  /// The number of the triangles' edge between two nodes.
  int edge(int from, int to) const;
  const std::array<int, 2>& ends(int edge) const { return edges_[edge]; }
  /// Of each triangle about an edge, the node across.
  std::span<const int> across(int edge) const { return across_.of(edge); }
  /// The nodes at the other ends of a node's edges.
  std::span<const int> neighbours(int node) const { return neighbours_.of(node); }

  /// Appends pairs without a common node whose gap at x is below what their nodes move by together (`reach`,
  /// m, one a node of the scene), and whose nearest points lie on them. Edges that are parallel are left to
  /// their nodes.
  void find(const Points& x, const std::vector<double>& reach, std::vector<SurfaceContact>& out);

  /// Appends nodes and triangles, and edges, that pass each other on the straight ways between two places of
  /// the nodes, or overlap where these end, by more than where they begin and `slack` (m): each on the side
  /// from which they came, with the gap at which they began if that was below zero.
  void find_passed(const Points& from, const Points& to, double slack, std::vector<PassedContact>& out);

 private:
  /// A sphere, or a node of a surface, of radius 0 m, that triangles and edges are looked for about. It
  /// touches at `margin` and half the thickness: a sphere's radius, or half the thickness as well (m).
  struct Point : NodeSphere {
    double margin = 0;

    bool touches(const std::array<int, 3>& triangle) const;
    /// A contact of it, but for its nodes.
    SurfaceContact contact(SurfaceContact::Kind kind, double half_thickness) const;
  };

  /// visit(point, nodes) for each point and triangle, visit(nodes) for each two edges, without a common node,
  /// whose boxes meet; box(nodes, margin) gives a feature's.
  template <class Box, class Visit>
  void each_node_and_triangle(Box&& box, Visit&& visit);
  template <class Box, class Visit>
  void each_pair_of_edges(Box&& box, Visit&& visit);
  /// visit(point, edge), by the edges' boxes of the last `each_pair_of_edges`.
  template <class Box, class Visit>
  void each_node_and_edge(Box&& box, Visit&& visit);

  void find_nodes(const Points& x, const std::vector<double>& reach, std::vector<SurfaceContact>& out);
  void find_edges(const Points& x, const std::vector<double>& reach, std::vector<SurfaceContact>& out);
  void find_nodes_beside(const Points& x, const std::vector<double>& reach, std::vector<SurfaceContact>& out);
  std::optional<SurfaceContact> beside(const Point& point, int edge, const Points& x, double moved);
  bool away_from(const SurfaceContact& contact, int edge, const SurfaceTouching& touching, const Points& x,
                 double moved) const;
  static int end_of(const SurfaceContact& contact, const SurfaceTouching& touching);

  /// Lists of numbers, one after the other.
  struct Lists {
    std::vector<int> first, all;

    explicit Lists(std::vector<std::array<int, 2>> pairs);  // list and entry, each once
    std::span<const int> of(int list) const {
      if (list + 1 >= std::ssize(first)) return {};
      return std::span(all).subspan(static_cast<std::size_t>(first[list]),
                                    static_cast<std::size_t>(first[list + 1] - first[list]));
    }
  };

  std::vector<std::array<int, 3>> triangles_;
  std::vector<std::array<int, 2>> edges_;
  Lists across_{{}}, neighbours_{{}};
  std::vector<int> nodes_;
  std::vector<Point> points_;
  double half_;  // of the thickness, m
  bool touch_;   // surfaces each other
  std::vector<AxisBox> boxes_;
  BoxTree tree_;
  std::vector<std::array<int, 2>> ends_;  // nodes that touch each other, of `beside`
};

template <class Box, class Visit>
void SurfaceSearch::each_node_and_triangle(Box&& box, Visit&& visit) {
  boxes_.clear();
  for (const auto& triangle : triangles_) boxes_.push_back(box(triangle, half_));
  tree_.build(boxes_);
  for (const Point& point : points_)
    tree_.find(box(std::array{point.node}, point.margin), [&](int k) {
      const auto& [a, b, c] = triangles_[k];
      if (point.touches(triangles_[k])) visit(point, std::array{point.node, a, b, c});
    });
}

template <class Box, class Visit>
void SurfaceSearch::each_pair_of_edges(Box&& box, Visit&& visit) {
  boxes_.clear();
  for (const auto& edge : edges_) boxes_.push_back(box(edge, half_));
  tree_.build(boxes_);
  if (!touch_) return;
  for (std::size_t i = 0; i < edges_.size(); ++i)
    tree_.find(boxes_[i], [&](int j) {
      const auto& [a, b] = edges_[i];
      const auto& [c, d] = edges_[j];
      const bool apart = a != c && a != d && b != c && b != d;
      if (static_cast<std::size_t>(j) > i && apart) visit(std::array{a, b, c, d});
    });
}

template <class Box, class Visit>
void SurfaceSearch::each_node_and_edge(Box&& box, Visit&& visit) {
  ends_.clear();
  for (const Point& point : points_)
    tree_.find(box(std::array{point.node}, point.margin), [&](int edge) { visit(point, edge); });
}

}  // namespace pbd
