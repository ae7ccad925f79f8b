// Semicircular arches of stones without mortar, and the thickness down to which they stand (heyman1966stone).
#pragma once

#include "scene.h"

namespace pbdcheck {

/// Stones of a semicircular arch of radius 1 m about y, of `thickness` (m), cut along radii.
struct Arch {
  double thickness;
  int stones;

  /// On the ground, at rest, body 0 the ground; friction 1.
  pbd::Scene scene() const;

  /// True if a line of thrust lies inside the stones.
  bool stands() const;

 private:
  double angle(int cut) const;  // rad, from the crown
  double inner() const { return 1 - thickness / 2; }
  double outer() const { return 1 + thickness / 2; }
  pbd::ConvexHull stone(int k) const;
};

/// m, the least thickness of an arch that stands.
double limit_thickness(int stones);

}  // namespace pbdcheck
