// The contacts of rows whose other blocks are eliminated (potential.h).
#pragma once

#include <vector>

#include "rows/rows.h"

namespace pbd {

/// f(block, i) for every contact: the rows that are not eliminated are no others.
template <class AnyRows, class F>
void each_contact(AnyRows& rows, const std::vector<bool>& eliminated, F&& f) {
  for (std::size_t b = 0; b < rows.blocks.size(); ++b) {
    if (eliminated[b]) continue;
    std::visit(
        [&]<class Block>(Block& block) {
          if constexpr ((Block::rows == 1 || Block::rows == 3) && !is_local<Block>)
            for (std::size_t i = 0; i < block.size(); ++i) f(block, i);
        },
        rows.blocks[b]);
  }
}

}  // namespace pbd
