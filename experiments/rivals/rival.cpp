#include "rivals/rival.h"

#include "rivals/newton.h"

namespace pbd::rivals {

std::span<const NamedRival> rivals() {
  static constexpr std::array<NamedRival, 1> list{{{"newton", newton}}};
  return list;
}

}  // namespace pbd::rivals
