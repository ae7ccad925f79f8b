// Which shapes may touch: pairs of boxes along the world's axes that intersect.
#pragma once

#include <array>
#include <vector>

#include "box_tree.h"

namespace pbd {

/// What collides: its box, whether it may move, and its group. Things that cannot move do not pair with each
/// other, nor do those of one group.
struct MovingBox {
  AxisBox box;
  bool moves = true;
  int group = 0;
};

/// Keeps its memory from step to step.
class BroadPhase {
 public:
  /// Pairs of intersecting boxes, the smaller index first, sorted. Of n boxes of which each is near a
  /// few, n log n. A tree of the project's own (the one for meshes, too) and not a library's: the solver has
  /// no dependency but Eigen, and the order of pairs must not depend on what was asked before.
  const std::vector<std::array<int, 2>>& pairs(const std::vector<MovingBox>& boxes);

 private:
  BoxTree tree_;
  std::vector<AxisBox> boxes_;
  std::vector<int> finite_, infinite_;
  std::vector<std::array<int, 2>> pairs_;
};

}  // namespace pbd
