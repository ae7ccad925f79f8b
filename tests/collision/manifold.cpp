#include <catch2/catch.hpp>
#include <map>
#include <numbers>

#include "contact_shapes.h"

using namespace pbd;
using namespace pbd::test;

namespace {

constexpr double pi = std::numbers::pi;

Frame turned(double angle, const Vec3& axis, const Vec3& origin) {
  return {origin, Eigen::AngleAxisd(angle, axis).toRotationMatrix()};
}

using Plane = Eigen::Vector2d;

/// Corners of the common part of two rectangles: corners of one in the other, and crossings of their sides.
std::vector<Plane> common_corners(const std::array<Plane, 4>& a, const std::array<Plane, 4>& b) {
  const auto cross = [](const Plane& u, const Plane& v) { return u.x() * v.y() - u.y() * v.x(); };
  const auto inside = [&](const Plane& x, const std::array<Plane, 4>& of) {
    for (std::size_t k = 0; k < 4; ++k)
      if (cross(of[(k + 1) % 4] - of[k], x - of[k]) < 0) return false;
    return true;
  };
  std::vector<Plane> found;
  for (const Plane& x : a)
    if (inside(x, b)) found.push_back(x);
  for (const Plane& x : b)
    if (inside(x, a)) found.push_back(x);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const Plane u = a[(i + 1) % 4] - a[i], v = b[(j + 1) % 4] - b[j], apart = b[j] - a[i];
      const double s = cross(apart, v) / cross(u, v), t = cross(apart, u) / cross(u, v);
      if (s > 0 && s < 1 && t > 0 && t < 1) found.emplace_back(a[i] + s * u);
    }
  return found;
}

std::array<Plane, 4> rectangle(const Vec3& size, const Frame& at) {
  std::array<Plane, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) {
    const double x = k == 1 || k == 2 ? 0.5 : -0.5, y = k >= 2 ? 0.5 : -0.5;
    corners[k] = at.place(Vec3(x * size.x(), y * size.y(), 0)).head<2>();
  }
  return corners;
}

std::map<std::uint64_t, Touching> by_key(const Shape& a, const Frame& at_a, const Shape& b, const Frame& at_b,
                                         double margin) {
  std::map<std::uint64_t, Touching> found;
  for (const auto& contact : contacts(a, at_a, b, at_b, margin)) {
    CHECK(!found.contains(contact.key));
    found[contact.key] = touch(contact, at_a, at_b);
  }
  return found;
}

}  // namespace

TEST_CASE("a box turned by 45 degrees on another touches it at eight points") {
  const Box box{Vec3::Ones()};
  const double gap = GENERATE(-1e-3, 0.0, 1e-3);
  const auto found = by_key(box, turned(pi / 4, Vec3::UnitZ(), {0, 0, 1 + gap}), box, {}, 0.01);
  CHECK(found.size() == 8);
  for (const auto& [key, t] : found) {
    CHECK(t.gap == Approx(gap).margin(1e-14));
    // The octagon's corners: (1/2, (sqrt(2) - 1)/2) and its mirrored ones.
    CHECK(std::max(std::abs(t.point_a.x()), std::abs(t.point_a.y())) == Approx(0.5));
    CHECK(std::min(std::abs(t.point_a.x()), std::abs(t.point_a.y())) == Approx((std::sqrt(2) - 1) / 2));
    CHECK(std::abs(t.normal.z()) == Approx(1));
  }
}

TEST_CASE("boxes face to face touch at the corners of their common rectangle") {
  Random random(23);
  int most = 0;
  for (int number = 0; number < 2000; ++number) {
    const Box a{{random.uniform(0.5, 2), random.uniform(0.5, 2), 1}},
        b{{random.uniform(0.5, 2), random.uniform(0.5, 2), 1}};
    const double gap = random.uniform(-0.01, 0.01);
    const Frame at_a = turned(random.uniform(0, 2 * pi), Vec3::UnitZ(),
                              {random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7), 1 + gap});
    const auto expected = common_corners(rectangle(a.size, at_a), rectangle(b.size, {}));
    const auto found = by_key(a, at_a, b, {}, 0.1);
    if (expected.empty() || found.begin()->second.normal.cross(Vec3::UnitZ()).norm() > 1e-9) continue;
    REQUIRE(found.size() == expected.size());
    most = std::max(most, static_cast<int>(found.size()));
    for (const auto& [key, t] : found) {
      double nearest = infinity;
      for (const Plane& x : expected) nearest = std::min(nearest, (x - t.point_a.head<2>()).norm());
      CHECK(nearest < 1e-9);
      CHECK(t.gap == Approx(gap).margin(1e-12));
    }
  }
  CHECK(most == 8);
}

TEST_CASE("a box tilted about an edge or a corner touches with its corners' heights") {
  const Vec3 size(0.6, 0.4, 0.3);
  const Shape ground =
      GENERATE(Shape(Box{{5, 5, 1}}), Shape(HalfSpace{}), Shape(ConvexHull(box_surface({5, 5, 1}))));
  const bool edge = GENERATE(true, false);
  const double level = std::holds_alternative<HalfSpace>(ground) ? 0 : 0.5, margin = 0.05;
  const Vec3 axis = edge ? Vec3::UnitY() : Vec3(1, 2, 0).normalized();
  for (double angle = 0; angle < 0.3; angle += 0.001) {
    Frame at = turned(angle, axis, Vec3::Zero());
    const TriangleMesh corners = box_surface(size);
    double lowest = infinity;
    for (int i = 0; i < 8; ++i) lowest = std::min(lowest, at.place(corners.x.col(i)).z());
    at.origin.z() = level - lowest - 1e-3;  // pressed in by 1 mm
    std::vector<double> expected;
    for (int i = 0; i < 8; ++i) {
      const double height = at.place(corners.x.col(i)).z() - level;
      if (height < margin) expected.push_back(height);
    }
    std::vector<double> found;
    for (const auto& [key, t] : by_key(Box{size}, at, ground, {}, margin)) found.push_back(t.gap);
    std::sort(expected.begin(), expected.end());
    std::sort(found.begin(), found.end());
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i] == Approx(expected[i]).margin(1e-12));
  }
}

TEST_CASE("gaps of a plank that tilts over an edge are continuous") {
  const Box plank{{2, 0.3, 0.1}}, table{{1, 1, 1}};
  constexpr double margin = 0.05, by = 1e-4;
  const double yaw = GENERATE(0.0, 0.3);
  std::map<std::uint64_t, Touching> before;
  for (double angle = -0.05; angle < 0.05; angle += by) {
    // About the table's edge at x = 0.5.
    const Eigen::Matrix3d tilt = Eigen::AngleAxisd(angle, Vec3::UnitY()).toRotationMatrix();
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(yaw, Vec3::UnitZ()).toRotationMatrix();
    const Vec3 pivot(0.5, 0, 0.5);
    const Frame at{pivot + tilt * Vec3(-0.3, 0, 0.051), tilt * turn};
    auto now = by_key(plank, at, table, {}, margin);
    REQUIRE(!now.empty());
    for (const auto& [key, t] : now) {
      const auto last = before.find(key);
      // A point within 2.2 m of the pivot moves by 2.2 m x angle, and a kind's change is 1e-4 of the gap.
      if (last != before.end()) CHECK(std::abs(t.gap - last->second.gap) < 2.2 * by + 1e-4 * margin);
    }
    before = std::move(now);
  }
}

TEST_CASE("a sphere touches a capsule or an edge once, in either order of the shapes") {
  const Shape sphere = Sphere{0.1}, capsule = Capsule{0.1, 0.5}, box = Box{Vec3(0.14, 0.14, 0.5)},
              other = GENERATE(true, false) ? capsule : box;
  // Within the margin the sphere is near the other's ends, too.
  const Frame at_sphere = turned(0, Vec3::UnitX(), {0.21, 0, 0.05}),
              at_other = turned(pi / 4, Vec3::UnitZ(), {});
  const bool first = GENERATE(true, false);
  CAPTURE(first, std::holds_alternative<Box>(other));
  CHECK(by_key(first ? sphere : other, first ? at_sphere : at_other, first ? other : sphere,
               first ? at_other : at_sphere, 0.5)
            .size() == 1);
}

TEST_CASE("what is deep in a box leaves through the nearest face") {
  const Box box{{2, 3, 4}};
  const Vec3 centre(0.1, -0.2, 1.7);  // 0.3 m below the face z = 2
  const auto found = contacts(Sphere{0.1}, {centre, Eigen::Matrix3d::Identity()}, box, {}, 0.01);
  REQUIRE(found.size() == 1);
  const Touching t = touch(found[0], {centre, Eigen::Matrix3d::Identity()}, {});
  CHECK(t.gap == Approx(-0.4));
  CHECK((t.normal - Vec3::UnitZ()).norm() < 1e-15);
}

TEST_CASE("round shapes on a half space: every end and rim") {
  Random random(29);
  for (int number = 0; number < 1000; ++number) {
    const Frame ground{random.vector(), random.rotation()};
    const Frame own{{0, 0, random.uniform(-1, 1)}, random.rotation()};
    const Frame at{ground.place(own.origin), ground.rotation * own.rotation};
    const double radius = random.uniform(0.1, 0.5), half = random.uniform(0.1, 0.5), height = own.origin.z();
    const double rise = half * own.rotation(2, 2);
    const auto gaps = [&](const Shape& shape) {
      std::vector<double> found;
      for (const auto& contact : contacts(ground.rotation(0, 0) > 0 ? shape : Shape(HalfSpace{}),
                                          ground.rotation(0, 0) > 0 ? at : ground,
                                          ground.rotation(0, 0) > 0 ? Shape(HalfSpace{}) : shape,
                                          ground.rotation(0, 0) > 0 ? ground : at, 10)) {
        CHECK(contact.swapped == (ground.rotation(0, 0) <= 0));
        found.push_back(touching(contact, at, ground).gap);
      }
      std::sort(found.begin(), found.end());
      return found;
    };
    const auto sphere = gaps(Sphere{radius}), capsule = gaps(Capsule{radius, 2 * half}),
               cylinder = gaps(Cylinder{radius, 2 * half});
    REQUIRE(sphere.size() == 1);
    CHECK(sphere[0] == Approx(height - radius).margin(1e-12));
    REQUIRE(capsule.size() == 2);
    CHECK(capsule[0] == Approx(height - std::abs(rise) - radius).margin(1e-12));
    CHECK(capsule[1] == Approx(height + std::abs(rise) - radius).margin(1e-12));
    const double sine = std::sqrt(1 - std::pow(own.rotation(2, 2), 2));
    REQUIRE(cylinder.size() >= 2);
    CHECK(cylinder.front() == Approx(height - std::abs(rise) - radius * sine).margin(1e-12));
    const double other = height + std::abs(rise) - radius * sine;
    CHECK(std::any_of(cylinder.begin(), cylinder.end(),
                      [&](double gap) { return std::abs(gap - other) < 1e-12; }));
  }
}

TEST_CASE("shapes that coincide have unit normals") {
  const auto kind =
      GENERATE(as<std::string>(), "node", "sphere", "capsule", "box", "hull", "cylinder", "half space");
  const auto other = GENERATE(as<std::string>(), "node", "sphere", "capsule", "box", "hull", "cylinder");
  Random random(31);
  for (int number = 0; number < 100; ++number) {
    const Shape a = random_shape(kind, random), b = random_shape(other, random);
    const Frame at{random.vector(), random.rotation()};
    const Frame at_b{at.origin, number % 2 == 0 ? at.rotation : random.rotation()};
    const auto found = contacts(a, at, b, at_b, 0.1);
    CHECK(!found.empty());
    for (const auto& contact : found) {
      const Touching t = touch(contact, at, at_b);
      CHECK(t.normal.norm() == Approx(1));
      CHECK(std::isfinite(t.gap));
      CHECK(t.point_a.allFinite());
    }
  }
}

TEST_CASE("no two pairs of features share a key, and the order of the shapes makes none") {
  const Frame at;
  std::vector<ContactPoint> found;
  const ContactWriter writer{at, at, false, Reach{0}, found, 0};
  std::vector<std::uint64_t> keys;
  constexpr int side = 300;  // keys of 32 bits would have some twenty pairs in common
  for (const Feature of_a : {Feature::node, Feature::face})
    for (const Feature of_b : {Feature::edge, Feature::cap})
      for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j) {
          keys.push_back(writer.key(of_a, 1789 * i, of_b, 1789 * j));
          if (writer.exchanged().key(of_b, 1789 * j, of_a, 1789 * i) != keys.back()) FAIL("other order");
        }
  std::sort(keys.begin(), keys.end());
  CHECK(std::adjacent_find(keys.begin(), keys.end()) == keys.end());
}

// Two boxes on edge, 2 mm in each other by upright edges that cross at 0.05 rad; the one then comes to be
// nearly parallel and 1 mm aside: the edges' lines cross 10 m off.
TEST_CASE("upright edges in each other touch on their boxes, however they turn") {
  const Box box{Vec3::Constant(0.2)};
  const Frame at_a = turned(pi / 4, Vec3::UnitZ(), Vec3::Zero());
  const auto leaning = [&](double angle, double aside) {
    const Frame upright = turned(pi / 4, Vec3::UnitZ(), {});
    return Frame{Vec3(0.2 * std::numbers::sqrt2 - 2e-3, aside, 0),
                 Eigen::AngleAxisd(angle, Vec3::UnitX()) * upright.rotation};
  };
  bool by_edges = false;
  for (const ContactPoint& contact : contacts(box, at_a, box, leaning(0.05, 0), 0.0)) {
    const Touching begun = touch(contact, at_a, leaning(0.05, 0)),
                   parallel = touch(contact, at_a, leaning(1e-4, 1e-3));
    by_edges |= std::abs(std::abs(begun.normal.x()) - 1) < 1e-9;
    INFO("normal " << begun.normal.transpose() << " at " << parallel.point_a.transpose());
    // A corner's distance; those of the other box reach over it by 2 mm, 1 mm and what 0.1 m lean by.
    CHECK(parallel.point_a.norm() <= 0.2 * std::numbers::sqrt3 / 2 + 2e-3 + 1e-3 + 0.05 * 0.1);
  }
  CHECK(by_edges);
}
