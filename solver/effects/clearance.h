// Steps that need no search: what is apart by many times its motion stays so for some steps.
#pragma once

#include <functional>
#include <vector>

#include "collision/broad_phase.h"
#include "rows/bodies.h"

namespace pbd {

/// By how much of it ways and courses are searched for farther than they are known to go.
inline constexpr double search_room = 0.25;

/// m, of a collider's farthest point about its body's centre; infinite for a half space.
double farthest_point(const Collider& collider);

class Clearance {
 public:
  explicit Clearance(const Contact& effect);

  using MayTouch = std::function<bool(int, int)>;  // of two colliders, the smaller index first

  /// Looks, now and then, how far what may touch is apart: `boxes` hold where it is searched for in a step
  /// from `start` in which nothing goes farther than `way`, m.
  void look(const std::vector<MovingBox>& boxes, const Configuration& start, double way,
            const MayTouch& may_touch);

  /// Begins a step: courses end at `straight`.
  void begin(const Bodies& bodies, const Configuration& start, const Points& straight);

  /// True if nothing comes near in the step whose motions end at `to`, as was seen. False where a number is
  /// not finite.
  bool holds(const Bodies& bodies, const Configuration& start, const Points& to) const;

 private:
  bool none_within(double distance, const std::vector<MovingBox>& boxes, const MayTouch& may_touch);
  double above_half_spaces(const std::vector<MovingBox>& boxes, const std::vector<Pose>& pose,
                           const MayTouch& may_touch) const;

  const Contact& effect_;
  std::vector<double> radius_;  // m, the farthest points of the colliders
  double distance_ = 0;         // m, that anything may go from where it was seen; 0 if that is not known
  double spent_ = 0;            // m, of that where the step begins, and by courses
  int to_wait_ = 0;             // searches, until it is looked again
  Points x_;                    // where it was seen
  std::vector<Pose> pose_;
  std::vector<AxisBox> boxes_;  // of the tree
  std::vector<int> owner_;
  BoxTree tree_;
};

}  // namespace pbd
