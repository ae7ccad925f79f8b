#include "rows/turned_way.h"

#include <algorithm>

namespace pbd {

int TurnedWay::count(double turn) {
  constexpr int fewest = 16, most = 10000;
  if (turn <= slow) return 1;
  return turn < most * most_apart ? std::max(fewest, static_cast<int>(turn / most_apart) + 1) : 0;
}

Configuration TurnedWay::at(double share) {
  x_ = share * extension_ * x_reached_;  // of arcs, which are zero as a step begins
  bodies_.place(x_, pose_);
  return {x_, pose_, time_};
}

}  // namespace pbd
