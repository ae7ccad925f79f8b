// Where a circle comes nearest to a line or another circle: at the points c of it with
//
//   (c - y(c)) . t(c) = 0, from below      y(c) the other's point nearest to c, t the tangent
//
// of which there are two where the other lies across the circle, and none where all are equally near.
#pragma once

#include <functional>
#include <vector>

#include "geometry.h"

namespace pbd::reference {

struct Circle {
  Vec3 middle, axis;  // axis: unit
  double radius = 0;  // m

  /// Of x, the circle's point nearest to it; the middle if x is on the axis.
  Vec3 nearest(const Vec3& x) const;
};

/// The points of a circle that are nearer to the other than those beside them, as `nearest_of_other` tells y.
/// Two that are less than 2 pi/128 apart may be one.
std::vector<Vec3> nearest_points(const Circle& circle,
                                 const std::function<Vec3(const Vec3&)>& nearest_of_other);

}  // namespace pbd::reference
