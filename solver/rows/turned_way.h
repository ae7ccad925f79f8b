// The turns of a step's whole way, in places between which no body turns by more than half a radian, or a
// single way where none turns by more than one. Each turns steadily.
#pragma once

#include <vector>

#include "rows/bodies.h"

namespace pbd {

class TurnedWay {
 public:
  static constexpr double most_apart = 0.5;  // rad, that a body turns from place to place
  static constexpr double slow = 1;          // rad: what turns by no more is looked at where it ends alone

  /// From where a step begins at `time` (s), `extension` times as far as to the positions x of all columns.
  /// No body turns by more than the larger of `turn` and `slow` (rad) on it.
  TurnedWay(const Bodies& bodies, const Points& x, double extension, double turn, double time)
      : bodies_(bodies), x_reached_(x), extension_(extension), places_(count(turn)), time_(time) {}

  /// 0 where there would be too many to look at.
  int places() const { return places_; }

  /// The share of the way at which place k of 0 (the start) to `places` (the end) is.
  double share(int k) const { return static_cast<double>(k) / places_; }

  /// Rotations alone at a share of the way, until the next call; what angles ask for is that of the start.
  Configuration at(double share);

 private:
  static int count(double turn);

  const Bodies& bodies_;
  const Points& x_reached_;
  double extension_;
  int places_;
  double time_;
  Points x_;
  std::vector<Pose> pose_;
};

}  // namespace pbd
