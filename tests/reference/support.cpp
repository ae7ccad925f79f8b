#include "support.h"

#include <catch2/catch.hpp>

using namespace pbd;
using reference::DistanceBounds;

namespace {

/// Corners of a box along the world's axes.
Points corners(const Vec3& least, const Vec3& most) {
  Points x(3, 8);
  for (int k = 0; k < 8; ++k)
    for (int axis = 0; axis < 3; ++axis) x(axis, k) = (k >> axis & 1) != 0 ? most[axis] : least[axis];
  return x;
}

}  // namespace

TEST_CASE("hulls of points are as far apart as their nearest faces, edges or corners") {
  const Points box = corners({-1, -1, -1}, {1, 1, 1});
  // The nearest points differ along those axes on which the boxes are apart.
  for (const Vec3& apart : {Vec3(2, 0, 0), Vec3(0.3, 0.4, 0), Vec3(0.2, 0.3, 0.6), Vec3(1e-6, 0, 0)}) {
    const Vec3 least = Vec3::Constant(1) + apart - (apart.array() == 0).matrix().cast<double>();
    const DistanceBounds found = reference::distance(corners(least, least + Vec3::Ones()), box);
    CHECK(std::abs(found.found - apart.norm()) <= 1e-12);
    CHECK(std::abs(found.proved - apart.norm()) <= 1e-12);
    CHECK((found.along - apart.normalized()).norm() <= 1e-9);
  }
  CHECK(reference::distance(corners({0.9, 0.9, 0.9}, {2, 2, 2}), box).proved == 0);
}
