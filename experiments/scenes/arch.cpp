#include "scenes/arch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/body_shapes.h"
#include "scenes/contacts.h"

namespace pbdcheck {

using namespace pbd;

double Arch::angle(int cut) const {
  return std::numbers::pi * (0.5 - static_cast<double>(cut) / stones);
}

ConvexHull Arch::stone(int k) const {
  Points corners(3, 8);
  int next = 0;
  for (const int cut : {k, k + 1})
    for (const double radius : {inner(), outer()})
      for (const double y : {-0.1, 0.1})
        corners.col(next++) = Vec3(radius * std::sin(angle(cut)), y, radius * std::cos(angle(cut)));
  return ConvexHull(convex_hull(corners));
}

Scene Arch::scene() const {
  BodyScene build({.friction = 1});
  build.ground();
  for (int k = 0; k < stones; ++k) build.hull(stone(k), 2300, {Vec3::Zero()});
  return build.finish();
}

// Of symmetric lines of thrust, with H the thrust at the crown at height y: at the cut at angle a from
// the crown the line is at the radius (H y + W x)/(H cos a + W sin a), W the weight between and x its
// place. It stays inside the stones if some H, H y have inner <= radius <= outer at all cuts (Heyman's
// safe theorem): linear in both, and the room that H leaves to H y is concave in H.
bool Arch::stands() const {
  const MassProperties crown = surface_properties(stone(stones / 2).surface, 1);
  const double mass = crown.mass, centre = crown.centre.z();  // of each stone, on its own radius
  const auto room = [&](double thrust) {
    double least = -infinity, most = infinity, weight = mass / 2;
    // Half of the middle stone: its area is a triangle outer less a triangle inner.
    const double half = std::numbers::pi / (2 * stones);
    const auto moment = [&](double radius) {
      return std::pow(radius, 3) * std::cos(half) * std::pow(std::sin(half), 2) / 6;
    };
    const auto area = [&](double radius) { return radius * radius * std::sin(half) * std::cos(half) / 2; };
    double turned = weight * (moment(outer()) - moment(inner())) / (area(outer()) - area(inner()));
    for (int cut = stones / 2; cut >= 0; --cut) {
      const double along = angle(cut);
      const double carried = thrust * std::cos(along) + weight * std::sin(along);
      least = std::max(least, inner() * carried - turned);
      most = std::min(most, outer() * carried - turned);
      turned += mass * centre * std::sin((angle(cut) + (cut > 0 ? angle(cut - 1) : 0)) / 2);
      weight += mass;
    }
    return most - least;
  };
  double low = 0, high = mass * stones;
  for (int k = 0; k < 200; ++k) {
    const double third = (high - low) / 3;
    if (room(low + third) < room(high - third))
      low += third;
    else
      high -= third;
  }
  return room(low) >= 0;
}

double limit_thickness(int stones) {
  double low = 0.01, high = 0.5;
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    (Arch{middle, stones}.stands() ? high : low) = middle;
  }
  return high;
}

}  // namespace pbdcheck
