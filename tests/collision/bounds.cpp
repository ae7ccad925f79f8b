// Boxes and balls about shapes, against how far the shapes reach by their supports.
#include "collision/bounds.h"

#include <catch2/catch.hpp>

#include "contact_shapes.h"

using namespace pbd;
using namespace pbd::test;

namespace {

constexpr std::array kinds{"node", "sphere", "capsule", "box", "cylinder", "hull", "mesh"};

}  // namespace

TEST_CASE("bounds hold each shape and touch it on all sides") {
  Random random(5);
  for (const std::string kind : kinds)
    for (int k = 0; k < 20; ++k) {
      const Shape shape = random_shape(kind, random);
      const Frame at{random.vector(), random.rotation()};
      const Eigen::AlignedBox3d box = bounds_of(shape, at);
      INFO(kind);
      for (int axis = 0; axis < 3; ++axis) {
        const Vec3 n = Vec3::Unit(axis);
        const double above = support(shape, at, n) - at.origin[axis],
                     below = support(shape, at, -n) + at.origin[axis];
        const double half = std::max(above, below);  // the box stands about the frame's origin
        CHECK(std::abs(box.max()[axis] - at.origin[axis] - half) <= accuracy);
        CHECK(std::abs(at.origin[axis] - box.min()[axis] - half) <= accuracy);
      }
    }
}

TEST_CASE("the ball about a shape holds it and touches it") {
  Random random(6);
  for (const std::string kind : kinds)
    for (int k = 0; k < 20; ++k) {
      const Shape shape = random_shape(kind, random);
      // Towards the farthest point: of each round shape and box known, of others among their nodes.
      std::vector<Vec3> farthest{Vec3::UnitZ()};
      if (const auto* box = std::get_if<Box>(&shape)) farthest = {box->size.normalized()};
      if (const auto* own = std::get_if<Cylinder>(&shape))
        farthest = {Vec3(own->radius, 0, own->length / 2).normalized()};
      if (kind == "hull" || kind == "mesh") {
        farthest.clear();
        for (const Vec3& x : convex(shape, {}).x) farthest.push_back(x.normalized());
      }
      double reach = 0;
      for (const Vec3& n : farthest) reach = std::max(reach, support(shape, {}, n));
      INFO(kind);
      CHECK(std::abs(bounding_radius(shape) - reach) <= accuracy);
      for (int i = 0; i < 20; ++i)
        CHECK(support(shape, {}, random.vector().normalized()) <= bounding_radius(shape) + accuracy);
    }
}
