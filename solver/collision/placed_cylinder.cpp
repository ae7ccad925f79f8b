#include "collision/placed_cylinder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "collision/tolerances.h"

namespace pbd {

Vec3 PlacedCylinder::on_rim(int end, double angle) const {
  return cap(end) + radius * (std::cos(angle) * across + std::sin(angle) * axis.cross(across));
}

Vec3 PlacedCylinder::farthest(const Vec3& n) const {
  const Vec3 aside = n - n.dot(axis) * axis;
  return cap(n.dot(axis) < 0 ? -1 : 1) + (aside.norm() > rounding ? radius : 0) * aside.normalized();
}

double PlacedCylinder::support(const Vec3& n) const {
  return half * std::abs(n.dot(axis)) + radius * (n - n.dot(axis) * axis).norm();
}

PlacedCylinder::Place PlacedCylinder::place(const Vec3& x) const {
  const double z = axis.dot(x - centre);
  const Vec3 aside = x - centre - z * axis;
  const double from_axis = aside.norm(), above = std::abs(z) - half, outside = from_axis - radius;
  const int end = z < 0 ? -1 : 1;
  const Vec3 radial = from_axis > 0 ? Vec3(aside / from_axis) : across;
  if (above > 0 && outside > 0) {
    const Vec3 nearest = cap(end) + radius * radial;
    const double distance = std::hypot(above, outside);
    return {distance, Part::rim, nearest, (outside * radial + above * end * axis) / distance, end};
  }
  if (above > outside) return {above, Part::cap, x - above * end * axis, end * axis, end};
  return {outside, Part::side, x - outside * radial, radial, end};
}

bool PlacedCylinder::is_beside_rim(int end, const Vec3& on_rim, const Vec3& outward) const {
  constexpr double leaning = 0.2;  // sine
  return end * outward.dot(axis) >= -leaning && outward.dot(on_rim - cap(end)) >= -leaning * radius;
}

double nearest_arc(const Segment& edge, const PlacedCylinder& b) {
  const auto slope = [&](double s) { return edge.along.dot(b.place(edge.at(s)).normal); };
  double low = 0, high = edge.length;
  if (slope(low) >= 0) return low;
  if (slope(high) <= 0) return high;
  constexpr int halvings = 60;  // 2^-60 of the length: below its rounding
  for (int k = 0; k < halvings; ++k) {
    const double middle = (low + high) / 2, here = slope(middle);
    if (here == 0) return middle;
    (here < 0 ? low : high) = middle;
  }
  return (low + high) / 2;
}

NearestAngles nearest_angles(const PlacedCylinder& a, int end, const PlacedCylinder& b, double reach) {
  constexpr int samples = 16, halvings = 52;  // 2^-52 of an arc is rounding
  constexpr double part = 2 * std::numbers::pi / samples;
  const auto distance = [&](double angle) { return b.place(a.on_rim(end, angle)).distance; };
  std::array<double, samples> sampled{};
  for (int k = 0; k < samples; ++k) sampled[k] = distance(k * part);
  struct Least {
    double distance = infinity, angle = 0;
  };
  std::array<Least, 2> least{};
  const auto add = [&](double angle, double here) {
    if (here < least[1].distance) least[1] = {here, angle};
    if (here < least[0].distance) std::swap(least[0], least[1]);
  };
  const auto at = [&](int k) { return sampled[(k + samples) % samples]; };
  const auto level = [&](int k) {
    return std::max(std::abs(at(k - 1) - at(k)), std::abs(at(k + 1) - at(k))) < rounding * a.radius;
  };
  for (int k = 0; k < samples; ++k) {
    const double here = sampled[k];
    if (level(k)) {
      if (!level(k - 1)) add(k * part, here);  // a stretch of the same distance counts once
      continue;
    }
    if (here >= at(k - 1) || here > at(k + 1) || here - part * a.radius > reach) continue;
    double low = (k - 1) * part, high = (k + 1) * part;
    for (int halving = 0; halving < halvings; ++halving) {
      const double middle = (low + high) / 2;
      const Vec3 y = a.on_rim(end, middle), along = a.axis.cross(y - a.cap(end));
      (b.place(y).normal.dot(along) < 0 ? low : high) = middle;
    }
    add(low, distance(low));
  }
  if (least[0].distance == infinity) add(0, sampled[0]);  // the same all around
  NearestAngles found;
  for (const Least& each : least)
    if (each.distance <= reach) found.angle[found.count++] = each.angle;
  return found;
}

}  // namespace pbd
