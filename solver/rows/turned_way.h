// The turns of a step's way, in places between which no body turns by more than half a radian, each steadily.
#pragma once

#include <vector>

#include "rows/bodies.h"

namespace pbd {

class TurnedWay {
 public:
  static constexpr double most_apart = 0.5;  // rad, that a body turns from place to place

  /// The way to positions x of all columns from where a step begins at `time` (s). No body turns by more than
  /// `turn` (rad) on it, or by more than a radian.
  TurnedWay(const Bodies& bodies, const Points& x, double turn, double time)
      : bodies_(bodies), end_(x), places_(count(turn)), time_(time) {}

  /// 0 where there would be too many to look at.
  int places() const { return places_; }

  /// The share of the way at which place k of 0 (the start) to `places` (the end) is.
  double share(int k) const { return static_cast<double>(k) / places_; }

  /// Rotations alone at a share of the way, until the next call; what angles ask for is that of the start.
  Configuration at(double share);

 private:
  static int count(double turn);

  const Bodies& bodies_;
  const Points& end_;
  int places_;
  double time_;
  Points x_;
  std::vector<Pose> pose_;
};

}  // namespace pbd
