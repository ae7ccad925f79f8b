#include "outer/components.h"

#include <algorithm>
#include <numeric>

namespace pbd {

void Components::find(const Rows& rows, const std::vector<double>& inverse_mass) {
  const auto columns = static_cast<int>(inverse_mass.size());
  parent_.resize(columns);
  std::iota(parent_.begin(), parent_.end(), 0);
  const auto root = [&](int column) {
    while (parent_[column] != column) column = parent_[column] = parent_[parent_[column]];
    return column;
  };
  const auto moves = [&](int column) { return inverse_mass[column] > 0; };
  for_each_block(rows.blocks, [&](const auto& block) {
    for (const auto& own : block.node) {
      const auto first = std::find_if(own.begin(), own.end(), moves);
      for (auto other = first; other != own.end(); ++other)
        if (moves(*other)) parent_[root(*other)] = root(*first);
    }
  });

  of_column.assign(columns, -1);
  held.clear();
  for (int column = 0; column < columns; ++column) {
    if (!moves(column)) continue;
    int& component = of_column[root(column)];
    if (component < 0) {
      component = static_cast<int>(held.size());
      held.push_back(false);
    }
    of_column[column] = component;
  }
  for_each_block(rows.blocks, [&]<class Block>(const Block& block) {
    for (const auto& own : block.node)
      if (const int component = of(own);
          component >= 0 && (Block::nodes == 1 || !std::all_of(own.begin(), own.end(), moves)))
        held[component] = true;
  });
}

}  // namespace pbd
