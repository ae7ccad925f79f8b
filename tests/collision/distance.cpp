#include <catch2/catch.hpp>

#include "contact_shapes.h"

using namespace pbd;
using namespace pbd::test;

namespace {

/// All over the other, apart or overlapping; every fourth pose has axes along the other's.
Frame random_pose(Random& random, int number) {
  Frame at;
  at.rotation = number % 4 == 0 ? random.quarter_turns() : random.rotation();
  at.origin = random.uniform(0, 1.6) * random.vector().normalized();
  return at;
}

}  // namespace

TEST_CASE("the least gap of convex pairs is their signed distance") {
  const auto kind = GENERATE(as<std::string>(), "node", "sphere", "capsule", "box", "hull");
  const auto other = GENERATE(as<std::string>(), "node", "sphere", "capsule", "box", "hull");
  Random random(7);
  double worst = 0, worst_a = 0, worst_b = 0, worst_normal = 0;
  int overlapping = 0, apart = 0, beyond = 0, missed = 0, ghosts = 0;
  for (int number = 0; number < 10000; ++number) {
    const Shape a = random_shape(kind, random), b = random_shape(other, random);
    const Frame at_b{random.vector(), random.rotation()};
    Frame at_a = random_pose(random, number);
    at_a = {at_b.place(at_a.origin), at_b.rotation * at_a.rotation};
    const double margin = random.uniform(0, 0.5);
    const Convex of_a = convex(a, at_a), of_b = convex(b, at_b);
    const double expected = signed_distance(of_a, of_b);

    double least = infinity;
    for (const auto& contact : contacts(a, at_a, b, at_b, margin)) {
      const Touching t = touch(contact, at_a, at_b);
      if (!(t.gap < margin)) ++ghosts;
      least = std::min(least, t.gap);
      worst_normal = larger(worst_normal, std::abs(t.normal.norm() - 1));
      const Convex point_a{{contact.swapped ? t.point_b : t.point_a}, {}, 0};
      const Convex point_b{{contact.swapped ? t.point_a : t.point_b}, {}, 0};
      worst_a = larger(worst_a, signed_distance(point_a, of_a));
      worst_b = larger(worst_b, signed_distance(point_b, of_b));
      if (t.gap > expected + accuracy) continue;
      worst_a = larger(worst_a, std::abs(signed_distance(point_a, of_a)));
      worst_b = larger(worst_b, std::abs(signed_distance(point_b, of_b)));
    }
    if (expected >= margin) {
      ++beyond;
      if (least < margin) ++ghosts;
      continue;
    }
    ++(expected < 0 ? overlapping : apart);
    if (least == infinity)
      ++missed;
    else
      worst = larger(worst, std::abs(least - expected));
    if (std::abs(least - expected) > accuracy && missed + ghosts < 1)
      UNSCOPED_INFO("pose " << number << " least " << least << " expected " << expected);
  }
  INFO(kind << " " << other << " overlapping " << overlapping << " apart " << apart << " beyond " << beyond
            << " off by " << worst << " points " << worst_a << " " << worst_b << " normal " << worst_normal);
  CHECK(missed == 0);
  CHECK(ghosts == 0);
  CHECK(worst < accuracy);
  CHECK(worst_normal < 1e-14);
  CHECK(worst_a < 1e-8);
  CHECK(worst_b < 1e-8);
  CHECK(apart > 100);
}

TEST_CASE("a node that lies on a cylinder hides no overlap elsewhere") {
  const double off = GENERATE(-1e-15, 0.0, 1e-15);  // m, that the node is above the cap
  Random random(67);
  int overlaps = 0, unseen = 0;
  for (int number = 0; number < 3000; ++number) {
    const TriangleMesh octahedron = shaken_octahedron(random);
    const Shape mesh = ClosedMesh(octahedron), solid = ConvexHull(octahedron);
    const Cylinder cylinder = std::get<Cylinder>(random_shape("cylinder", random));
    Frame at{Vec3::Zero(), random.rotation()};
    const Vec3 on_cap(random.uniform(0, cylinder.radius), 0, cylinder.length / 2 + off);
    at.origin = on_cap - at.place(octahedron.x.col(number % 6));
    const auto least = [&](const Shape& other) {
      double gap = infinity;
      for (const auto& contact : contacts(cylinder, {}, other, at, 0.01))
        gap = std::min(gap, touch(contact, {}, at).gap);
      return gap;
    };
    if (!(least(solid) < -1e-6)) continue;
    ++overlaps;
    unseen += !(least(mesh) < -1e-6);
  }
  CHECK(overlaps > 500);
  CHECK(unseen == 0);
}
