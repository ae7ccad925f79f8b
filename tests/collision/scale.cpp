// Contact geometry knows no length of its own: shapes and poses times a power of two have the same contacts,
// bit by bit, with gaps and points times that power. A length in metres among the constants would show.
#include <catch2/catch.hpp>

#include "contact_shapes.h"

using namespace pbd;
using namespace pbd::test;

namespace {

TriangleMesh times(double scale, TriangleMesh mesh) {
  mesh.x *= scale;
  return mesh;
}

struct Scaled {
  double scale;

  Shape operator()(std::monostate) const { return {}; }
  Shape operator()(const Sphere& s) const { return Sphere{scale * s.radius}; }
  Shape operator()(const Box& s) const { return Box{scale * s.size}; }
  Shape operator()(const Cylinder& s) const { return Cylinder{scale * s.radius, scale * s.length}; }
  Shape operator()(const Capsule& s) const { return Capsule{scale * s.radius, scale * s.length}; }
  Shape operator()(const ClosedMesh& s) const { return ClosedMesh(times(scale, s.surface)); }
  Shape operator()(const ConvexHull& s) const { return ConvexHull(times(scale, s.surface)); }
  Shape operator()(const HalfSpace& s) const { return s; }
};

/// All over b, and every other time with a's origin (of capsules and cylinders, the axis) next to a node of b
/// or to b's axis: at distances from 1e-14 m to 1e-4 m.
Vec3 place_near(const Shape& b, int number, Random& random) {
  Vec3 far = random.uniform(0, 1.6) * random.vector().normalized();
  Vec3 near = std::pow(10, random.uniform(-14, -4)) * random.vector().normalized();
  if (number % 2 == 0) return far;
  if (const auto* mesh = std::get_if<ClosedMesh>(&b)) return mesh->surface.x.col(number % 6) + near;
  return near;
}

}  // namespace

TEST_CASE("contacts of shapes a thousand times as large are a thousand times as large, bit by bit") {
  const auto kind =
      GENERATE(as<std::string>(), "node", "sphere", "capsule", "box", "cylinder", "hull", "mesh");
  const auto other = GENERATE(as<std::string>(), "node", "sphere", "capsule", "box", "cylinder", "hull",
                              "mesh", "half space");
  const double scale = GENERATE(1024.0, 1.0 / 1024);
  Random random(59);
  int seen = 0, differ = 0;
  for (int number = 0; number < 500; ++number) {
    const Shape a = random_shape(kind, random), b = random_shape(other, random);
    const Shape large_a = std::visit(Scaled{scale}, a), large_b = std::visit(Scaled{scale}, b);
    const Frame at_b;
    const Frame at_a{place_near(b, number, random),
                     number % 3 == 0 ? random.quarter_turns() : random.rotation()};
    const Frame large_at_a{scale * at_a.origin, at_a.rotation};
    const auto found = contacts(a, at_a, b, at_b, 0.1);
    const auto large = contacts(large_a, large_at_a, large_b, at_b, scale * 0.1);
    seen += !found.empty();
    bool same = found.size() == large.size();
    for (std::size_t i = 0; same && i < found.size(); ++i) {
      const Touching t = touch(found[i], at_a, at_b), u = touch(large[i], large_at_a, at_b);
      same = found[i].key == large[i].key && found[i].kind == large[i].kind && scale * t.gap == u.gap &&
             t.normal == u.normal && scale * t.point_a == u.point_a && scale * t.point_b == u.point_b;
    }
    differ += !same;
  }
  INFO(kind << " " << other << " times " << scale);
  CHECK(seen > 100);
  CHECK(differ == 0);
}
