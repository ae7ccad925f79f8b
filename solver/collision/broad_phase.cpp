#include "collision/broad_phase.h"

#include <algorithm>

namespace pbd {

const std::vector<std::array<int, 2>>& BroadPhase::pairs(const std::vector<MovingBox>& boxes) {
  const auto at = [&](int i) -> const MovingBox& { return boxes[i]; };
  boxes_.clear();
  finite_.clear();
  infinite_.clear();
  pairs_.clear();
  for (int i = 0; i < static_cast<int>(boxes.size()); ++i) {
    if (at(i).box.isEmpty()) continue;
    const bool finite = at(i).box.min().allFinite() && at(i).box.max().allFinite();
    (finite ? finite_ : infinite_).push_back(i);
    if (finite) boxes_.push_back(at(i).box);
  }
  const auto pair = [&](int i, int j) {
    if ((at(i).moves || at(j).moves) && at(i).group != at(j).group)
      pairs_.push_back({std::min(i, j), std::max(i, j)});
  };
  const bool pairs_among_finite = std::any_of(
      finite_.begin(), finite_.end(), [&](int i) { return at(i).group != at(finite_.front()).group; });
  if (pairs_among_finite) {
    tree_.build(boxes_);
    for (const int i : finite_)
      tree_.find(at(i).box, [&](int k) {
        const int j = finite_[k];
        if (i < j) pair(i, j);
      });
  }
  for (std::size_t n = 0; n < infinite_.size(); ++n) {
    const int i = infinite_[n];
    for (const int j : finite_)
      if (at(i).box.intersects(at(j).box)) pair(i, j);
    for (std::size_t m = n + 1; m < infinite_.size(); ++m)
      if (at(i).box.intersects(at(infinite_[m]).box)) pair(i, infinite_[m]);
  }
  std::sort(pairs_.begin(), pairs_.end());
  return pairs_;
}

}  // namespace pbd
