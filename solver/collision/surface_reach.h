// How far the nodes of deformable surfaces go in a step: the nodes of each connected piece by a common
// course, which brings no two of them nearer, and each node beside that.
#pragma once

#include <array>
#include <vector>

#include "box_tree.h"
#include "geometry.h"

namespace pbd {

inline constexpr double way_rounding = 1e-9;  // of a way

/// Where more is `reached` than was searched for, searches `room` times as far beyond that, and returns true.
inline bool search_farther(double& searched, double reached, double room) {
  if (!(reached > (1 + way_rounding) * searched)) return false;
  searched = (1 + room) * reached;
  return true;
}

class SurfaceReach {
 public:
  SurfaceReach() = default;
  SurfaceReach(const std::vector<std::array<int, 3>>& triangles, const std::vector<int>& nodes);

  /// Courses lead to `straight`. Nodes may go to `free`, and farther by `room` times what their course goes
  /// beside the mean of all.
  void set_out(const Points& start, const Points& straight, const Points& free, double room);
  /// True if nodes go farther to x than was told before; they may then go farther than that, by the share
  /// `room`.
  bool extend(const Points& start, const Points& x, double room);

  /// About where these nodes, of one piece, go from x, seen from what moves by the mean course.
  template <std::size_t K>
  AxisBox box(const std::array<int, K>& nodes, const Points& x, double margin) const {
    AxisBox box;
    for (const int node : nodes) {
      const Vec3 slack = Vec3::Constant(beside_[node] + margin),
                 to = x.col(node) + course_[piece_[node]] - mean_;
      box.extend(Vec3(x.col(node) - slack)).extend(Vec3(x.col(node) + slack));
      box.extend(Vec3(to - slack)).extend(Vec3(to + slack));
    }
    return box;
  }
  /// m, by which the gap of a contact of these nodes may fall, the first and the last of which are of its two
  /// sides.
  double of(const std::array<int, 4>& nodes) const;
  /// m, no less than that of any nodes.
  double most() const;

 private:
  std::vector<int> nodes_;
  std::vector<int> piece_;        // of each node of the scene up to the last of these
  std::vector<Vec3> course_;      // m, of each piece
  std::vector<double> in_piece_;  // nodes
  Vec3 mean_ = Vec3::Zero();      // m, of all nodes' courses
  std::vector<double> beside_;    // m, of each node
};

}  // namespace pbd
