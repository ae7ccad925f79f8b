// Shapes against a triangle of a deformable surface.
#include <catch2/catch.hpp>

#include "contact_shapes.h"
#include "hollow_meshes.h"
#include "mesh_depth.h"

using namespace pbd;
using namespace pbd::test;

namespace {

struct Placed {
  RoundedTriangle triangle;
  std::array<Vec3, 3> corner;

  Placed(const std::array<Vec3, 3>& x, double radius) : corner(x) {
    triangle.radius = radius;
    triangle.place(x);
  }
  Convex convex() const {
    return {{corner[0], corner[1], corner[2]}, {{0, 1, 2}, {0, 2, 1}}, triangle.radius};
  }
};

Placed random_triangle(Random& random) {
  const Vec3 centre = random.uniform(0, 1.2) * random.vector().normalized();
  return {{centre + 0.5 * random.vector(), centre + 0.5 * random.vector(), centre + 0.5 * random.vector()},
          random.uniform(0.01, 0.1)};
}

std::vector<ContactPoint> contacts(const Placed& a, const Shape& b, const Frame& at, double margin) {
  CollisionScratch scratch;
  std::vector<ContactPoint> found;
  generate(a.triangle, b, at, Reach{margin}, scratch, found);
  return found;
}

Points columns(const std::array<Vec3, 3>& corner) {
  Points x(3, 3);
  x << corner[0], corner[1], corner[2];
  return x;
}

/// Where the triangle's nodes have moved to.
Touching followed(const ContactPoint& contact, const RoundedTriangle& triangle, const Points& x,
                  const Frame& at, TriangleFeature& feature) {
  const int side = contact.swapped ? 1 : 0;
  feature = feature_of(contact, side, triangle, {0, 1, 2});
  ContactPoint moved = contact;
  follow(feature, x, side, moved);
  const Frame world;
  return side == 0 ? touching(moved, world, at) : touching(moved, at, world);
}

}  // namespace

TEST_CASE("the least gap over a triangle is the signed distance from it") {
  const auto kind =
      GENERATE(as<std::string>(), "node", "sphere", "capsule", "box", "hull", "cylinder", "mesh");
  Random random(91);
  double worst = 0, normal = 0;
  int apart = 0, touching = 0, missed = 0, ghosts = 0;
  for (int number = 0; number < 5000; ++number) {
    const Shape shape = random_shape(kind, random);
    const Frame at{random.vector(), random.rotation()};
    Placed placed = random_triangle(random);
    for (Vec3& x : placed.corner) x += at.origin;
    placed = {placed.corner, placed.triangle.radius};
    const double margin = random.uniform(0, 0.5);
    const auto found = contacts(placed, shape, at, margin);
    double least = infinity;
    const Frame world;
    for (const ContactPoint& contact : found) {
      const Touching t = touch(contact, world, at);
      least = std::min(least, t.gap);
      normal = larger(normal, std::abs(t.normal.norm() - 1));
      if (!(t.gap < margin)) ++ghosts;
    }
    if (kind == "cylinder") {  // a proof by a direction stands for the distance
      for (const ContactPoint& contact : found) {
        const Touching t = touch(contact, world, at);
        if (t.gap != least || !(least > 0)) continue;
        ++apart;
        const Vec3 n = contact.swapped ? Vec3(-t.normal) : t.normal;
        double low = infinity;
        for (const Vec3& x : placed.corner) low = std::min(low, n.dot(x));
        worst = larger(worst, std::abs(least - (low - placed.triangle.radius - support(shape, at, n))));
        break;
      }
      continue;
    }
    const double expected = signed_distance(placed.convex(), convex(shape, at));
    if (expected >= margin) {
      if (least < margin) ++ghosts;
      continue;
    }
    if (expected <= -placed.triangle.radius) continue;  // the triangle itself cuts the shape: it has no side
    ++(expected > 0 ? apart : touching);
    if (least == infinity)
      ++missed;
    else
      worst = larger(worst, std::abs(least - expected));
  }
  INFO(kind << " apart " << apart << " touching " << touching << " off by " << worst);
  CHECK(missed == 0);
  CHECK(ghosts == 0);
  CHECK(worst < accuracy);
  CHECK(normal < 1e-14);
  CHECK(apart > 100);
}

TEST_CASE("what of a mesh is in a triangle, or goes through it, is told to be in it") {
  const int kind = GENERATE(0, 1, 2);
  const Shape mesh = ClosedMesh(kind == 0 ? star() : kind == 1 ? angle_profile() : blade(0.3));
  Random random(37);
  int through = 0, shallow = 0;
  for (int number = 0; number < 2000; ++number) {
    const Frame at{random.vector(), random.rotation()};
    const Placed placed = random_triangle(random);
    const double radius = placed.triangle.radius;
    if (!(reference::proved_depth({&mesh, at}, placed.corner, radius) >= radius)) continue;
    ++through;
    double least = infinity;
    for (const ContactPoint& contact : contacts(placed, mesh, at, 0))
      least = std::min(least, touch(contact, {}, at).gap);
    if (!(least <= -radius)) ++shallow;
  }
  CHECK(through > 100);
  CHECK(shallow == 0);
}

TEST_CASE("what a contact holds on to of a triangle follows its nodes") {
  const auto kind = GENERATE(as<std::string>(), "sphere", "capsule", "box", "hull", "cylinder", "mesh");
  Random random(17);
  double begin = 0, sum = 0, place = 0, slope = 0;
  int seen = 0;
  for (int number = 0; number < 600; ++number) {
    const Shape shape = random_shape(kind, random);
    const Frame at{Vec3::Zero(), random.rotation()};
    const Placed placed = random_triangle(random);
    const Points x = columns(placed.corner);
    Points shift(3, 3);
    for (int k = 0; k < 3; ++k) shift.col(k) = random.vector();
    for (const ContactPoint& contact : contacts(placed, shape, at, 0.3)) {
      TriangleFeature feature;
      const Touching before = followed(contact, placed.triangle, x, at, feature);
      if (before.gap < -placed.triangle.radius / 2) continue;
      ++seen;
      begin = larger(begin, std::abs(before.gap - touch(contact, {}, at).gap));
      // The place is on the triangle, by weights whose derivative of the gap is their share of the normal's.
      const bool is_a = !contact.swapped;
      const Vec3 own = is_a ? Vec3(before.point_a + contact.radius_a * before.normal)
                            : Vec3(before.point_b - contact.radius_b * before.normal);
      const Vec3 weight = weights_at(feature, x, own);
      sum = larger(sum, std::abs(weight.sum() - 1));
      place = larger(place, (x * weight - own).norm());
      constexpr double step = 1e-6;
      const double up = followed(contact, placed.triangle, x + step * shift, at, feature).gap,
                   down = followed(contact, placed.triangle, x - step * shift, at, feature).gap;
      // `feature` is that of the start, since it is read from the contact as it was found there.
      const double expected = (is_a ? 1 : -1) * before.normal.dot(shift * weight);
      slope = larger(slope, std::abs((up - down) / (2 * step) - expected) / (1 + shift.norm()));
    }
  }
  INFO(kind << " contacts " << seen << " gap " << begin << " weights " << sum << " place " << place
            << " slope " << slope);
  CHECK(seen > 100);
  CHECK(begin < accuracy);
  CHECK(sum < 1e-12);
  CHECK(place < 1e-9);
  CHECK(slope < 1e-6);
}

TEST_CASE("an edge on a cylinder's side that a turn may bring lowest is told, and no other") {
  // Over a cylinder along y a triangle whose edge along x is a little farther than what is behind it.
  constexpr double radius = 0.1, rise = 1e-4, apart = 1e-3;
  const Frame lying{Vec3::Zero(), Eigen::AngleAxisd(-std::acos(-1.0) / 2, Vec3::UnitX()).toRotationMatrix()};
  RoundedTriangle triangle;
  triangle.place({Vec3(-0.5, -0.1, radius + apart + 0.2 * rise), Vec3(0.5, -0.1, radius + apart + 0.2 * rise),
                  Vec3(0, 0.1, radius + apart)});
  CollisionScratch scratch;
  std::vector<ContactPoint> found;
  for (const double turn : {0.0, rise / 2, 2 * rise}) {
    found.clear();
    generate(triangle, Cylinder{radius, 1}, lying, Reach{0.01, turn}, scratch, found);
    const auto edges = std::count_if(found.begin(), found.end(), [](const ContactPoint& contact) {
      return contact.kind == ContactPoint::Kind::edges;
    });
    INFO("turn " << turn);
    CHECK(edges == (turn > rise ? 1 : 0));
  }
}
