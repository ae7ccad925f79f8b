// The blocks of a scene's contacts, each with the contacts whose rows it has.
#pragma once

#include "effects/contact_search.h"
#include "rows/rows.h"

namespace pbd {

/// f(block, its contacts) for each block of contacts; there is none where nothing can touch.
template <class Blocks, class Lists, class F>
void with_contacts(Blocks&& blocks, Lists& contacts, F&& f) {
  for (std::size_t group = 0; group < blocks.size(); ++group)
    std::visit(
        [&]<class Block>(Block& block) {
          if constexpr ((Block::rows == 1 || Block::rows == 3) && Block::nodes >= 3 && Block::nodes <= 5 &&
                        !is_local<Block>)
            f(block, contacts[group]);
        },
        blocks[group]);
}

}  // namespace pbd
