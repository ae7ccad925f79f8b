// A tree of boxes along the axes, halved at the median of the longest side: finds what may be near.
#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace pbd {

using AxisBox = Eigen::AlignedBox3d;  // m

class BoxTree {
 public:
  void build(const std::vector<AxisBox>& boxes);

  /// Calls `visit` with the index of every box that intersects `box`, always in the same order. `visit` may
  /// shrink `box`.
  template <class Visit>
  void find(const AxisBox& box, Visit&& visit) const {
    if (!nodes_.empty()) descend(0, box, visit);
  }

 private:
  struct Node {
    AxisBox box;
    int leaf;    // index of the box given, or -1
    int second;  // the first child follows its parent
  };

  template <class Visit>
  void descend(std::size_t at, const AxisBox& box, Visit& visit) const {
    const Node& node = nodes_[at];
    if (!node.box.intersects(box)) return;
    if (node.leaf >= 0) return visit(node.leaf);
    descend(at + 1, box, visit);
    descend(node.second, box, visit);
  }

  void split(const std::vector<AxisBox>& boxes, std::size_t begin, std::size_t end);

  std::vector<Node> nodes_;
  std::vector<int> order_;
};

}  // namespace pbd
