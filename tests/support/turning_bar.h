// A bar whose corners pass the ground and never touch it.
#pragma once

#include <cmath>
#include <numbers>

#include "scenes/contacts.h"

namespace pbd::test {

/// It turns in place by 0.08 rad a step of 0.01 s, at the end of which a corner still comes down, 0.6 mm
/// above the ground: at its speed where the step begins it would be 1.6 mm below. It comes down to 0.5 mm.
inline Scene turning_bar() {
  constexpr double side = 1, speed = 8, from_lowest = 0.1;
  const double tilt = std::numbers::pi / 4 - from_lowest, height = side / std::numbers::sqrt2 + 5e-4;
  pbdcheck::BodyScene build({.friction = 0, .restitution = 1}, 0);
  build.ground();
  build.box({side, 0.3, side}, 1,
            {.position = {0, 0, height},
             .orientation = Eigen::Quaterniond(Eigen::AngleAxisd(tilt, Vec3::UnitY())),
             .spin = {0, speed, 0}});
  return build.finish();
}

}  // namespace pbd::test
