#include "rows/turned_way.h"

#include <algorithm>

namespace pbd {

int TurnedWay::count(double turn) {
  constexpr double apart = 0.5;  // rad
  constexpr int fewest = 16, most = 10000;
  return turn < most * apart ? std::max(fewest, static_cast<int>(turn / apart) + 1) : 0;
}

Configuration TurnedWay::at(int k) {
  x_ = static_cast<double>(k) / places_ * end_;  // of arcs, which are zero as a step begins
  bodies_.place(x_, pose_);
  return {x_, pose_, 0};
}

}  // namespace pbd
