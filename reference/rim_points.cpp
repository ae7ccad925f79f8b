#include "rim_points.h"

#include <cmath>
#include <numbers>

namespace pbd::reference {

Vec3 Circle::nearest(const Vec3& x) const {
  const Vec3 from = x - middle, across = from - axis.dot(from) * axis;
  const double length = across.norm();
  return length > 0 ? Vec3(middle + radius / length * across) : middle;
}

std::vector<Vec3> nearest_points(const Circle& circle,
                                 const std::function<Vec3(const Vec3&)>& nearest_of_other) {
  constexpr int parts = 128, halvings = 50;
  constexpr double part = 2 * std::numbers::pi / parts;
  const Vec3 u = circle.axis.unitOrthogonal(), v = circle.axis.cross(u);
  const auto at = [&](double angle) -> Vec3 {
    return circle.middle + circle.radius * (std::cos(angle) * u + std::sin(angle) * v);
  };
  const auto slope = [&](double angle) {
    const Vec3 x = at(angle);
    return (x - nearest_of_other(x)).dot(std::cos(angle) * v - std::sin(angle) * u);
  };
  std::vector<Vec3> found;
  double before = slope(0);
  for (int k = 1; k <= parts; ++k) {
    const double here = slope(k == parts ? 0 : k * part);
    if (before < 0 && here >= 0) {
      double low = (k - 1) * part, high = k * part;
      for (int i = 0; i < halvings; ++i) {
        const double middle = (low + high) / 2;
        (slope(middle) < 0 ? low : high) = middle;
      }
      found.push_back(at(high));
    }
    before = here;
  }
  return found;
}

}  // namespace pbd::reference
