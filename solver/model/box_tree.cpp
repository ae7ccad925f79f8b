#include "box_tree.h"

#include <algorithm>
#include <numeric>

namespace pbd {

void BoxTree::build(const std::vector<AxisBox>& boxes) {
  nodes_.clear();
  order_.resize(boxes.size());
  std::iota(order_.begin(), order_.end(), 0);
  if (!boxes.empty()) split(boxes, 0, boxes.size());
}

void BoxTree::split(const std::vector<AxisBox>& boxes, std::size_t begin, std::size_t end) {
  const auto box_of = [&](int i) -> const AxisBox& { return boxes[i]; };
  AxisBox box, centres;
  for (std::size_t i = begin; i < end; ++i) {
    box.extend(box_of(order_[i]));
    centres.extend(box_of(order_[i]).center());
  }
  const std::size_t at = nodes_.size();
  nodes_.push_back({box, end - begin == 1 ? order_[begin] : -1, -1});
  if (end - begin == 1) return;
  Eigen::Index axis = 0;
  centres.sizes().maxCoeff(&axis);
  const std::size_t middle = begin + (end - begin) / 2;
  const auto from = order_.begin();
  std::nth_element(from + static_cast<std::ptrdiff_t>(begin), from + static_cast<std::ptrdiff_t>(middle),
                   from + static_cast<std::ptrdiff_t>(end), [&](int i, int j) {
                     const double ci = box_of(i).center()[axis], cj = box_of(j).center()[axis];
                     return ci < cj || (ci == cj && i < j);
                   });
  split(boxes, begin, middle);
  nodes_[at].second = static_cast<int>(nodes_.size());
  split(boxes, middle, end);
}

}  // namespace pbd
