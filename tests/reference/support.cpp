#include "support.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "polyhedron.h"
#include "ways_apart.h"

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

/// The depth of two shapes, m, as ways_apart tells it, of which no way beside it parts them sooner.
void check_depth(const Shape& one, const Frame& at_one, const Shape& two, const Frame& at_two, double depth) {
  const reference::PlacedShape a{&one, at_one}, b{&two, at_two};
  const auto ways = reference::ways_apart(a, b);
  CHECK(std::abs(reference::separation(a, b, ways) + depth) <= 1e-12);
  CHECK(std::abs(reference::least_parting(a, b, ways).apart + depth) <= 1e-12);
}

Frame frame(const Vec3& origin, double angle, const Vec3& axis) {
  return {origin, Eigen::AngleAxisd(angle, axis).toRotationMatrix()};
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

TEST_CASE("shapes in each other are as deep as the least way that parts them") {
  // Boxes that cross edge on edge 0.05 m deep, and hulls of the same corners.
  const Shape box = Box{{1, 1, 1}}, hull = ConvexHull(box_surface({1, 1, 1}));
  const Frame lower = frame(Vec3::Zero(), std::numbers::pi / 4, Vec3::UnitX()),
              upper = frame({0.02, 0.03, std::sqrt(2.0) - 0.05}, std::numbers::pi / 4, Vec3::UnitY());
  for (const Shape* one : {&box, &hull})
    for (const Shape* two : {&box, &hull}) check_depth(*one, upper, *two, lower, 0.05);
  // Capsules whose axes cross 0.05 m apart, a ball 0.05 m beside the one's axis near its end, and one whose
  // centre is 0.05 m from a box's edge.
  const Shape capsule = Capsule{0.1, 1}, ball = Sphere{0.1};
  const Frame upright = frame(Vec3::Zero(), 0, Vec3::UnitZ());
  check_depth(capsule, upright, capsule, frame({0.3, 0.05, 0.2}, std::numbers::pi / 2, Vec3::UnitY()), 0.15);
  check_depth(ball, frame({0.03, 0.04, 0.45}, 0, Vec3::UnitX()), capsule, upright, 0.15);
  check_depth(ball, frame({0.53, 0.1, 0.54}, 0, Vec3::UnitX()), box, upright, 0.05);
}
