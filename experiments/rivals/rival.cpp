#include "rivals/rival.h"

#include "rivals/newton.h"
#include "rivals/xpbd.h"

namespace pbd::rivals {

std::span<const NamedRival> rivals() {
  static constexpr std::array<NamedRival, 2> list{{{"newton", newton, true}, {"xpbd", xpbd, false}}};
  return list;
}

}  // namespace pbd::rivals
