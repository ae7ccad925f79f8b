// Points of two convex shapes are as near as the shapes can be if a plane's gap along some direction is as
// wide as the points are apart: each pose brings its own proof.
#include <catch2/catch.hpp>

#include "collision/bounds.h"
#include "contact_shapes.h"

using namespace pbd;
using namespace pbd::test;

namespace {

struct Worst {
  double proof = 0, a = 0, b = 0, normal = 0;  // m
  int apart = 0, missed = 0, overlapping = 0, unproved = 0, shallow = 0, ghosts = 0;
};

void look(const Shape& a, const Frame& at_a, const Shape& b, const Frame& at_b, Random& random,
          Worst& worst) {
  const auto found = contacts(a, at_a, b, at_b, 1.0);
  Touching nearest;
  nearest.gap = infinity;
  bool swapped = false;
  for (const auto& contact : found) {
    const Touching t = touch(contact, at_a, at_b);
    worst.normal = larger(worst.normal, std::abs(t.normal.norm() - 1));
    if (t.gap >= nearest.gap) continue;
    nearest = t;
    swapped = contact.swapped;
  }
  double seen = -infinity;  // a lower bound of the distance
  for (const auto& contact : found) {
    const Vec3 n = touch(contact, at_a, at_b).normal;
    seen = larger(seen, apart_along(a, at_a, b, at_b, contact.swapped ? Vec3(-n) : n));
  }
  for (int k = 0; k < 30; ++k)
    seen = larger(seen, apart_along(a, at_a, b, at_b, random.vector().normalized()));
  if (found.empty()) {
    for (int k = 0; k < 3000 && seen < 0.9; ++k)  // enough to tell that shapes are 1 m apart
      seen = larger(seen, apart_along(a, at_a, b, at_b, random.vector().normalized()));
    if (seen < 0.9) ++worst.missed;
    return;
  }
  const Vec3 normal = swapped ? Vec3(-nearest.normal) : nearest.normal;
  const double proved = apart_along(a, at_a, b, at_b, normal);
  if (nearest.gap > 0) {
    ++worst.apart;
    worst.proof = larger(worst.proof, std::abs(nearest.gap - proved));
    worst.a = larger(worst.a, outside(a, at_a, swapped ? nearest.point_b : nearest.point_a));
    worst.b = larger(worst.b, outside(b, at_b, swapped ? nearest.point_a : nearest.point_b));
  } else {
    ++worst.overlapping;
    if (!(std::abs(nearest.gap - proved) <= accuracy)) ++worst.unproved;
    if (!(seen <= nearest.gap + accuracy)) ++worst.shallow;
    if (!(seen <= accuracy)) ++worst.ghosts;
  }
}

/// The point of a cylinder that is farthest along a direction that is none of its own, in the world (m).
Vec3 farthest_on_rim(const Cylinder& cylinder, const Frame& at, const Vec3& along) {
  const Vec3 axis = at.rotation.col(2), aside = along - along.dot(axis) * axis;
  return at.origin + std::copysign(cylinder.length / 2, along.dot(axis)) * axis +
         cylinder.radius * aside.normalized();
}

}  // namespace

TEST_CASE("contacts of cylinders are nearest points, with a proof") {
  const auto kind =
      GENERATE(as<std::string>(), "node", "sphere", "capsule", "box", "hull", "cylinder", "mesh");
  const bool first = GENERATE(true, false);
  Random random(11);
  Worst worst;
  for (int number = 0; number < 10000; ++number) {
    const Shape a = random_shape(kind, random), b = random_shape("cylinder", random);
    const Frame at_b{random.vector(), random.rotation()};
    Frame at_a;
    at_a.rotation = at_b.rotation * (number % 4 == 0 ? random.quarter_turns() : random.rotation());
    at_a.origin = at_b.place(random.uniform(0, 2) * random.vector().normalized());
    if (first)
      look(a, at_a, b, at_b, random, worst);
    else
      look(b, at_b, a, at_a, random, worst);
  }
  INFO(kind << " apart " << worst.apart << " overlapping " << worst.overlapping << " unproved "
            << worst.unproved << " shallow " << worst.shallow << " proof " << worst.proof << " points "
            << worst.a << " " << worst.b << " missed " << worst.missed);
  CHECK(worst.apart > 1000);
  CHECK(worst.missed == 0);
  CHECK(worst.proof < accuracy);
  CHECK(worst.a < accuracy);
  CHECK(worst.b < accuracy);
  CHECK(worst.normal < 1e-12);
  CHECK(worst.ghosts == 0);
  if (kind != "mesh") CHECK(worst.unproved == 0);
  if (kind == "node" || kind == "sphere") CHECK(worst.shallow == 0);
}

TEST_CASE("what has just entered a cylinder is as deep in it as it went") {
  constexpr double entered = 1e-10, allowed = 1e-7;  // m; the normal of nearest points is known to 1e-8
  const auto kind = GENERATE(as<std::string>(), "sphere", "capsule", "box", "hull", "cylinder");
  Random random(17);
  int seen = 0, deep = 0;
  for (int number = 0; number < 2000; ++number) {
    const Shape a = random_shape(kind, random), b = random_shape("cylinder", random);
    const Frame at_b{random.vector(), random.rotation()};
    Frame at_a{at_b.place(random.uniform(0, 2) * random.vector().normalized()), random.rotation()};
    const auto nearest = [&] {
      Touching best;
      best.gap = infinity;
      for (const auto& contact : contacts(a, at_a, b, at_b, 1.0)) {
        Touching t = touch(contact, at_a, at_b);
        if (contact.swapped) t.normal *= -1;
        if (t.gap < best.gap) best = t;
      }
      return best;
    };
    const Touching apart = nearest();
    if (!(apart.gap > 0 && apart.gap < 1)) continue;
    at_a.origin -= (apart.gap + entered) * apart.normal;
    ++seen;
    if (!(std::abs(nearest().gap) <= allowed)) ++deep;
  }
  INFO(kind << " of " << seen);
  CHECK(seen > 200);
  CHECK(deep == 0);
}

TEST_CASE("cylinders whose rims go through each other are told a way out that none nearby is shorter than") {
  // Along the shortest way nearby the deepest points of both lie on one normal; not so where it is across a
  // side, near which the deepest point jumps from one end of the side to the other.
  constexpr double near_side = 0.02, off_normal = 1e-5;  // off normal (rad) by the root of rounding, and more
  Random random(7);
  int seen = 0, longer = 0;
  for (int number = 0; number < 100000; ++number) {
    const auto a = std::get<Cylinder>(random_shape("cylinder", random));
    const auto b = std::get<Cylinder>(random_shape("cylinder", random));
    const Frame at_a{0.5 * random.vector(), random.rotation()}, at_b{Vec3::Zero(), random.rotation()};
    Touching deepest;
    deepest.gap = 0;
    for (const auto& contact : contacts(a, at_a, b, at_b, 0)) {
      Touching t = touch(contact, at_a, at_b);
      if (contact.swapped) t.normal *= -1;
      if (t.gap < deepest.gap) deepest = t;
    }
    const auto across_rim = [&](const Frame& at) {
      const Vec3 axis = at.rotation.col(2);
      return std::abs(deepest.normal.dot(axis)) > near_side && deepest.normal.cross(axis).norm() > near_side;
    };
    const double depth = -deepest.gap;
    if (!(depth > 0 && depth < 0.02 && across_rim(at_a) && across_rim(at_b))) continue;
    ++seen;
    const Vec3 through = farthest_on_rim(b, at_b, deepest.normal) - farthest_on_rim(a, at_a, -deepest.normal);
    if (!(through.cross(deepest.normal).norm() <= off_normal)) ++longer;
  }
  INFO("of " << seen);
  CHECK(seen > 200);
  CHECK(longer == 0);
}

TEST_CASE("what has a point in common with a closed mesh or a cylinder is told to overlap it") {
  const auto kind = GENERATE(as<std::string>(), "sphere", "capsule", "box", "hull", "cylinder", "disc");
  const auto other = GENERATE(as<std::string>(), "mesh", "cylinder");
  Random random(19);
  int overlapping = 0, untold = 0;
  for (int number = 0; number < 1000; ++number) {
    const Shape a = kind == "disc" ? Shape{Cylinder{0.5, 0.02}} : random_shape(kind, random),
                b = random_shape(other, random);
    const Frame at_b{random.vector(), random.rotation()},
        at_a{at_b.place(random.uniform(0, 1) * random.vector().normalized()), random.rotation()};
    const auto common = [&] {
      const Vec3 x = at_a.place(
          bounding_radius(a) *
          (kind == "disc" ? Vec3(random.vector().cwiseProduct(Vec3(1, 1, 0.02))) : random.vector()));
      return outside(a, at_a, x) == 0 && outside(b, at_b, x) == 0;
    };
    bool overlap = false;
    for (int k = 0; k < 200 && !overlap; ++k) overlap = common();
    if (!overlap) continue;
    ++overlapping;
    double least = infinity;
    for (const auto& contact : contacts(a, at_a, b, at_b, 1.0))
      least = std::min(least, touch(contact, at_a, at_b).gap);
    untold += !(least < 0);
  }
  INFO(kind << " and " << other << ": of " << overlapping);
  CHECK(overlapping > 250);
  CHECK(untold == 0);
}

TEST_CASE("the middle of a thin disc is no way through for a rod") {
  for (const double aside : {0.1, 0.4})
    for (const double tilt : {0.0, 0.02, 0.3}) {
      const Frame rod{Vec3(aside, 0, 0), Eigen::AngleAxisd(tilt, Vec3::UnitY()).toRotationMatrix()};
      double least = infinity;
      for (const auto& contact : contacts(Cylinder{0.05, 1}, rod, Cylinder{0.5, 0.01}, {}, 1.0))
        least = std::min(least, touch(contact, rod, {}).gap);
      CHECK(least < -0.01);  // the disc's thickness, and more
    }
}

TEST_CASE("a cylinder's rim goes through an edge of a closed mesh as far as it goes") {
  const double root = std::sqrt(0.5), tilt = 0.4, quarter = std::atan(1.0);
  const Frame at_mesh{Vec3::Zero(), Eigen::AngleAxisd(quarter, Vec3::UnitY()).toRotationMatrix()};
  for (const double apart : {1e-6, 1e-10, 0.0, -1e-10, -1e-9, -2e-9, -1e-6}) {
    const double height = root + 0.25 * std::cos(tilt) + 0.2 * std::sin(tilt) + apart;
    const Frame at{Vec3(0, 0.03, height), Eigen::AngleAxisd(tilt, Vec3::UnitX()).toRotationMatrix()};
    double least = infinity;
    for (const auto& contact :
         contacts(Cylinder{0.2, 0.5}, at, ClosedMesh(box_surface(Vec3(1, 1, 1))), at_mesh, 0.01))
      least = std::min(least, touch(contact, at, at_mesh).gap);
    CHECK(std::abs(least - apart) <= 1e-12);
  }
}

TEST_CASE("the least gap over a half space is the height of the lowest point") {
  const auto kind =
      GENERATE(as<std::string>(), "node", "sphere", "capsule", "box", "hull", "cylinder", "mesh");
  Random random(13);
  double worst = 0;
  int missed = 0, ghosts = 0;
  for (int number = 0; number < 10000; ++number) {
    const Shape shape = random_shape(kind, random);
    const Frame ground{random.vector(), random.rotation()};
    Frame at{ground.place(random.vector()), ground.rotation};
    at.rotation *= number % 4 == 0 ? random.quarter_turns() : random.rotation();
    const double margin = random.uniform(0, 1);
    const double expected = apart_along(shape, at, HalfSpace{}, ground, ground.rotation.col(2));
    double least = infinity;
    for (const auto& contact : contacts(shape, at, HalfSpace{}, ground, margin)) {
      const Touching t = touch(contact, at, ground);
      least = std::min(least, t.gap);
      worst = larger(worst, std::abs(t.gap - ground.rotation.col(2).dot(t.point_a - ground.origin)));
    }
    if (expected >= margin) {
      ghosts += least < infinity;
      continue;
    }
    missed += !(least < infinity);
    worst = larger(worst, std::abs(least - expected));
  }
  INFO(kind << " off by " << worst);
  CHECK(missed == 0);
  CHECK(ghosts == 0);
  CHECK(worst < 1e-13);
}
