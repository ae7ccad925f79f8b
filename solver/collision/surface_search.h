// Finds what deformable surfaces and spheres about nodes touch, and what they passed.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "box_tree.h"
#include "collision/surface_contact.h"
#include "collision/surface_reach.h"
#include "geometry.h"
#include "threads/threads.h"

namespace pbd {

/// A node that is a sphere, of no triangle. It touches no triangle with one of the nodes that it is `kept`
/// from, ascending.
struct NodeSphere {
  int node = 0;
  double radius = 0;  // m
  std::vector<int> kept{};
};

/// What may touch, or came to overlap on a way: then with the gap that is asked for, m.
struct PassedContact {
  SurfaceContact contact;
  double target = 0;
};

/// Finds what may touch: surfaces each other and themselves at a distance of `thickness`, if they `touch` at
/// all, and spheres surfaces at half of it. Keeps triangles' edges and scratch from step to step. What is
/// found, and in which order, does not depend on the number of threads. Where nothing is near it looks how
/// far apart all is, and does not search again before nodes may have gone half as far beside their mean
/// course.
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

  /// True if nothing comes near, at x and on the way from there to `to`, as was seen where it was last
  /// looked.
  bool stays_clear(const Points& x, const Points& to) const;

  /// Appends pairs without a common node that may come to touch: whose gap at x is below what `reach` says it
  /// may fall by, and whose nearest points lie on them. Edges that are parallel are left to their nodes.
  void find(int threads, const Points& x, const SurfaceReach& reach, std::vector<SurfaceContact>& out);

  /// Appends nodes and triangles, and edges, that pass each other on the straight ways between two places of
  /// the nodes, or overlap where these end, by more than where they begin and `slack` (m): each on the side
  /// from which they came, with the gap at which they began if that was below zero.
  void find_passed(int threads, const Points& from, const Points& to, double slack,
                   std::vector<PassedContact>& out);

 private:
  /// A sphere, or a node of a surface, of radius 0 m, that triangles and edges are looked for about. It
  /// touches at `margin` and half the thickness: a sphere's radius, or half the thickness as well (m).
  struct Point : NodeSphere {
    double margin = 0;

    bool touches(const std::array<int, 3>& triangle) const;
    /// A contact of it, but for its nodes.
    SurfaceContact contact(SurfaceContact::Kind kind, double half_thickness) const;
  };

  /// A node beside an edge; if it is nearest to one of its ends, the two nodes, ascending, else -1.
  struct Beside {
    SurfaceContact contact;
    std::array<int, 2> ends{-1, -1};
    bool again = false;  // the two nodes are in an earlier one
  };
  /// What a part of the points and of the edges meets.
  struct Task {
    std::vector<PassedContact> on_triangles, on_edges;
    std::vector<Beside> beside;
  };

  /// Fills `met_` with what look(contact) returns for each point and triangle, and each two edges, without a
  /// common node, whose boxes meet, and `beside_` with look_beside(point, edge) likewise. box(nodes, margin)
  /// is a feature's box.
  template <class Box, class Look, class LookBeside>
  void search(int threads, Box&& box, Look&& look, LookBeside&& look_beside);
  template <class Look>
  void look_at_edges(std::size_t begin, std::size_t end, Look&& look, std::vector<PassedContact>& out) const;
  void gather();

  void look_for_clearance(int threads, const Points& x);
  Vec3 course(const Points& from, const Points& to) const;
  double farthest_beside_course(const Points& from, const Points& to) const;
  double moved_since_clear(const Points& x) const;
  std::optional<SurfaceContact> of_edge(const Point& point, int edge) const;
  std::optional<Beside> beside(const Point& point, int edge, const Points& x, double moved) const;
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
  std::vector<AxisBox> triangle_boxes_, edge_boxes_;
  BoxTree triangle_tree_, edge_tree_;
  std::vector<Task> tasks_;
  std::vector<PassedContact> met_;
  std::vector<Beside> beside_;
  std::vector<std::pair<std::array<int, 2>, std::size_t>> ends_;  // of `beside_`, with their positions
  bool found_ = false;                                            // by the last search, something near
  Points clear_at_;       // m, where it was looked how far apart all is
  double looked_ = 0;     // m, up to which gap
  double clear_gap_ = 0;  // m, that no pair had less than there; 0 if one had less than `looked_`
};

template <class Box, class Look, class LookBeside>
void SurfaceSearch::search(int threads, Box&& box, Look&& look, LookBeside&& look_beside) {
  const auto plant = [&](const auto& features, std::vector<AxisBox>& boxes, BoxTree& tree) {
    boxes.clear();
    for (const auto& nodes : features) boxes.push_back(box(nodes, half_));
    tree.build(boxes);
  };
  each_task(threads, 2, [&](std::size_t k) {
    k == 0 ? plant(triangles_, triangle_boxes_, triangle_tree_) : plant(edges_, edge_boxes_, edge_tree_);
  });
  tasks_.resize(threads > 1 ? most_tasks : 1);
  each_task(threads, tasks_.size(), [&](std::size_t k) {
    Task& task = tasks_[k];
    task.on_triangles.clear();
    task.on_edges.clear();
    task.beside.clear();
    const auto part = [&](std::size_t count, std::size_t of) { return of * count / tasks_.size(); };
    for (std::size_t i = part(points_.size(), k); i < part(points_.size(), k + 1); ++i) {
      const Point& point = points_[i];
      const AxisBox around = box(std::array{point.node}, point.margin);
      triangle_tree_.find(around, [&](int at) {
        if (!point.touches(triangles_[at])) return;
        const auto& [a, b, c] = triangles_[at];
        SurfaceContact contact = point.contact(SurfaceContact::Kind::node_triangle, half_);
        contact.node = {point.node, a, b, c};
        if (const auto found = look(contact)) task.on_triangles.push_back(*found);
      });
      edge_tree_.find(around, [&](int edge) {
        if (const auto found = look_beside(point, edge)) task.beside.push_back(*found);
      });
    }
    if (touch_) look_at_edges(part(edges_.size(), k), part(edges_.size(), k + 1), look, task.on_edges);
  });
  gather();
}

template <class Look>
void SurfaceSearch::look_at_edges(std::size_t begin, std::size_t end, Look&& look,
                                  std::vector<PassedContact>& out) const {
  for (std::size_t i = begin; i < end; ++i)
    edge_tree_.find(edge_boxes_[i], [&](int j) {
      const auto& [a, b] = edges_[i];
      const auto& [c, d] = edges_[j];
      const bool apart = a != c && a != d && b != c && b != d;
      if (static_cast<std::size_t>(j) <= i || !apart) return;
      if (const auto found =
              look({.node = {a, b, c, d}, .kind = SurfaceContact::Kind::edge_edge, .thickness = 2 * half_}))
        out.push_back(*found);
    });
}

}  // namespace pbd
