#include "rivals/rival.h"

#include "rivals/newton.h"
#include "rivals/vbd.h"
#include "rivals/xpbd.h"

namespace pbd::rivals {

std::span<const NamedRival> rivals() {
  static constexpr std::array<NamedRival, 3> list{
      {{"newton", newton, true}, {"vbd", vbd, true}, {"xpbd", xpbd, false}}};
  return list;
}

}  // namespace pbd::rivals
