#include "effects/collider_motion.h"

#include <algorithm>
#include <cmath>

namespace pbd {
namespace {

/// Of the points that the other one may reach, m.
double travel_near(const ColliderMotion& motion, const ColliderMotion& other) {
  if (std::isfinite(motion.radius)) return motion.travel;
  const double apart = (other.centre - motion.centre).norm() + (other.course - motion.course).norm();
  return motion.travel + motion.turn * (apart + other.radius + other.travel);
}

}  // namespace

double farthest_travel(const ColliderMotion& motion, const Displacement& moved) {
  if (motion.kind == Carrier::triangle) return moved.shift;
  return std::isfinite(motion.radius) ? moved.shift + motion.radius * moved.turn : moved.shift;
}

double travel_between(const ColliderMotion& one, const ColliderMotion& two) {
  return (one.course - two.course).norm() + travel_near(one, two) + travel_near(two, one);
}

double round_radius_of(const ColliderMotion& one, const ColliderMotion& two) {
  const auto round = [](const ColliderMotion& own) {
    return own.kind == Carrier::body ? own.round : infinity;
  };
  return std::min(round(one), round(two));
}

}  // namespace pbd
