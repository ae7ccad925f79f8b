// Nearest points of two segments (ericson2005collision, 5.1.9).
#pragma once

#include <algorithm>

#include "geometry.h"

namespace pbd {

struct Segment {
  const Vec3& from;
  const Vec3& along;  // unit, or zero for a point
  double length;      // m

  Vec3 at(double arc) const { return from + arc * along; }
};

struct Nearest {
  double s, t;  // m, from the ends `from`
  Vec3 apart;   // from b's point to a's (m)
};

inline Nearest nearest(const Segment& a, const Segment& b) {
  constexpr double parallel = 1e-14;  // of the squared sine: 1 - cosine^2 is known to 1e-16
  const Vec3 apart = b.from - a.from;
  const double cosine = a.along.dot(b.along), along_a = apart.dot(a.along), along_b = apart.dot(b.along);
  const double sine_squared = a.along.squaredNorm() * b.along.squaredNorm() - cosine * cosine;
  double s = sine_squared > parallel ? (along_a - cosine * along_b) / sine_squared : along_a;
  s = std::clamp(s, 0.0, a.length);
  const double t = std::clamp(cosine * s - along_b, 0.0, b.length);
  s = std::clamp(cosine * t + along_a, 0.0, a.length);
  return {s, t, a.at(s) - b.at(t)};
}

}  // namespace pbd
