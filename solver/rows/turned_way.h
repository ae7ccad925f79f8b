// The turns of a step's way, in places between which no body turns by more than half a radian, each steadily.
#pragma once

#include <vector>

#include "rows/bodies.h"

namespace pbd {

class TurnedWay {
 public:
  /// The way to positions x of all columns, on which no body turns by more than `turn` (rad).
  TurnedWay(const Bodies& bodies, const Points& x, double turn)
      : bodies_(bodies), end_(x), places_(count(turn)) {}

  /// 0 where there would be too many to look at.
  int places() const { return places_; }

  /// Place k of 0 (the start) to `places` (the end), until the next call: rotations alone.
  Configuration at(int k);

 private:
  static int count(double turn);

  const Bodies& bodies_;
  const Points& end_;
  int places_;
  Points x_;
  std::vector<Pose> pose_;
};

}  // namespace pbd
