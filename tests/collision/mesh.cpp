#include <catch2/catch.hpp>

#include "contact_shapes.h"
#include "refined.h"

using namespace pbd;
using namespace pbd::test;

TEST_CASE("the least gap of a convex mesh that is apart is its distance") {
  const auto kind = GENERATE(as<std::string>(), "node", "sphere", "capsule", "box", "hull", "mesh");
  const bool first = GENERATE(true, false);
  Random random(37);
  double worst = 0, deepest = 0;
  int apart = 0, inside = 0, missed = 0, overlaps = 0, unseen = 0, deeper = 0;
  for (int number = 0; number < 10000; ++number) {
    const TriangleMesh octahedron = shaken_octahedron(random), other = shaken_octahedron(random);
    const Shape mesh = ClosedMesh(octahedron);
    const Shape a = kind == "mesh" ? Shape(ClosedMesh(other)) : random_shape(kind, random);
    const Frame at_mesh{random.vector(), random.rotation()};
    const Frame at{at_mesh.place(random.uniform(0, 1.8) * random.vector().normalized()), random.rotation()};
    const Convex of_a = convex(a, at), of_mesh = convex(mesh, at_mesh);
    const double expected = signed_distance(of_a, of_mesh);
    const double margin = random.uniform(0, 0.5);
    double least = infinity;
    const auto found =
        first ? contacts(a, at, mesh, at_mesh, margin) : contacts(mesh, at_mesh, a, at, margin);
    for (const auto& contact : found) {
      const Touching t = first ? touch(contact, at, at_mesh) : touch(contact, at_mesh, at);
      least = std::min(least, t.gap);
      CHECK(t.normal.norm() == Approx(1).epsilon(1e-12));
    }
    if (expected >= margin) {
      missed += least < margin;
    } else if (expected >= 0 || kind == "node" || kind == "sphere") {
      ++(expected < 0 ? inside : apart);
      if (least == infinity)
        ++missed;
      else
        worst = larger(worst, std::abs(least - expected));
    } else if (expected > -0.05) {
      ++overlaps;
      if (!(least < 0)) ++unseen;
      double by_faces = -infinity;
      for (const Convex* of : {&of_a, &of_mesh})
        for (const auto& t : of->triangles)
          by_faces = larger(by_faces, apart_along(of_a, of_mesh, of->normal(t)));
      if (by_faces > 0 || kind == "capsule" || least >= by_faces - accuracy) continue;
      ++deeper;
      deepest = larger(deepest, least / by_faces);
    }
  }
  INFO(kind << " apart " << apart << " inside " << inside << " overlaps " << overlaps << " unseen " << unseen
            << " deeper than along any face " << deeper << ", at most " << deepest << " times");
  CHECK(100 * deeper <= overlaps);
  CHECK(unseen == 0);
  CHECK(apart > 500);
  CHECK(missed == 0);
  CHECK(worst < accuracy);
}

TEST_CASE("a closed mesh of a box is as far from other shapes as the box is") {
  const auto kind =
      GENERATE(as<std::string>(), "node", "sphere", "capsule", "box", "hull", "cylinder", "mesh");
  Random random(47);
  double worst = 0;
  int apart = 0, differ = 0;
  for (int number = 0; number < 10000; ++number) {
    const Box box = std::get<Box>(random_shape("box", random));
    const Shape other = random_shape(kind, random), mesh = ClosedMesh(box_surface(box.size));
    const Shape convex_other =
        kind == "mesh" ? Shape(ConvexHull(std::get<ClosedMesh>(other).surface)) : other;
    const Frame at_box{random.vector(), random.rotation()};
    Frame at{at_box.place(random.uniform(0, 1.8) * random.vector().normalized()), at_box.rotation};
    at.rotation *= number % 2 == 0 ? random.quarter_turns() : random.rotation();
    const auto least = [&](const Shape& a, const Shape& b) {
      double gap = infinity;
      for (const auto& contact : contacts(a, at, b, at_box, 1))
        gap = std::min(gap, touch(contact, at, at_box).gap);
      return gap;
    };
    const double of_mesh = least(other, mesh), of_box = least(convex_other, box);
    if ((of_mesh < 0) != (of_box < 0)) ++differ;
    if (!(of_box > 0 && of_box < 1)) continue;
    ++apart;
    worst = larger(worst, std::abs(of_mesh - of_box));
  }
  INFO(kind << " apart " << apart << " off by " << worst);
  CHECK(apart > 500);
  CHECK(differ == 0);
  CHECK(worst < accuracy);
}

TEST_CASE("a rod that reaches behind the faces of a thin plate is as far from it as from a box") {
  const Vec3 size(1, 1, 0.05);
  const Shape plate = ClosedMesh(box_surface(size)), rod = Cylinder{0.05, 1.5};
  Random random(61);
  int behind = 0;
  for (int number = 0; number < 2000; ++number) {
    const Frame at{random.uniform(0.3, 0.8) * random.vector().normalized(), random.rotation()};
    const auto least = [&](const Shape& other) {
      double gap = infinity;
      for (const auto& contact : contacts(rod, at, other, {}, 1))
        gap = std::min(gap, touch(contact, at, {}).gap);
      return gap;
    };
    const double of_box = least(Box{size});
    if (!(of_box > 0)) continue;
    behind += std::abs(at.origin.z()) < std::abs(0.7 * at.rotation(2, 2));  // both sides of the plate's plane
    CHECK(least(plate) == Approx(of_box).margin(accuracy));
  }
  CHECK(behind > 200);
}

TEST_CASE("edges within a flat side of a mesh are not felt") {
  const Shape ground = ClosedMesh(refined(refined(refined(refined(box_surface({6, 6, 1}))))));
  const auto kind =
      GENERATE(as<std::string>(), "node", "sphere", "capsule", "box", "hull", "cylinder", "mesh");
  Random random(41);
  for (int number = 0; number < 300; ++number) {
    const Shape shape = random_shape(kind, random);
    Frame at{{random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), 0}, random.rotation()};
    // The lowest point 1 mm above the ground, then 1 mm below it.
    const Shape solid = kind == "mesh" ? Shape(ConvexHull(std::get<ClosedMesh>(shape).surface)) : shape;
    for (const double gap : {1e-3, -1e-3}) {
      at.origin.z() = 0;
      at.origin.z() = 0.5 + support(solid, at, -Vec3::UnitZ()) + gap;
      const auto found = contacts(shape, at, ground, {}, 5e-3);
      double least = infinity;
      for (const auto& contact : found) {
        const Touching t = touch(contact, at, {});
        least = std::min(least, t.gap);
        // Faces that are level to 0.014 rad feel nodes, those of meshes to 0.1 rad.
        CHECK(std::abs(t.normal.z()) > (kind == "mesh" ? 1 - 5.1e-3 : 1 - 1.01e-4));
      }
      CHECK(least == Approx(gap).margin(1e-9));
      if (kind == "node" || kind == "sphere") CHECK(found.size() == 1);
    }
  }
}

TEST_CASE("what stands on a flat side of a mesh, touching or nearly so, is pushed along its normal") {
  const Shape ground = ClosedMesh(refined(refined(refined(refined(box_surface({6, 6, 1}))))));
  const auto kind = GENERATE(as<std::string>(), "sphere", "capsule", "box", "hull", "cylinder", "mesh");
  const double gap = GENERATE(0.0, 1e-17, -1e-17, 1e-12, -1e-12, 1e-6, -1e-6);
  Random random(53);
  for (int number = 0; number < 50; ++number) {
    Shape shape = random_shape(kind, random);
    if (kind == "hull") shape = ConvexHull(box_surface({0.5, 0.75, 1}));
    if (kind == "mesh") shape = ClosedMesh(box_surface({0.5, 0.75, 1}));
    Frame at;  // at first edges and nodes stand on each other
    if (number > 0) at.origin << random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), 0;
    if (number % 2 == 0) at.rotation = random.quarter_turns();
    at.origin.z() = 0.5 + support(shape, at, -Vec3::UnitZ()) + gap;
    const auto found = contacts(shape, at, ground, {}, 1e-3);
    CHECK(!found.empty());
    for (const auto& contact : found) {
      const Touching t = touch(contact, at, {});
      CHECK(std::abs(t.normal.z()) > 1 - 1e-12);
      CHECK(t.gap == Approx(gap).margin(1e-14));
    }
  }
}

TEST_CASE("a corner that lies on a mesh hides no overlap elsewhere") {
  const auto kind = GENERATE(as<std::string>(), "box", "hull", "mesh");
  Random random(59);
  int overlaps = 0, unseen = 0;
  for (int number = 0; number < 3000; ++number) {
    const TriangleMesh octahedron = shaken_octahedron(random);
    const Shape mesh = ClosedMesh(octahedron), a = random_shape(kind, random);
    const auto& nodes = octahedron.triangles[static_cast<std::size_t>(number) % octahedron.triangles.size()];
    const Vec3 middle =
        (octahedron.x.col(nodes[0]) + octahedron.x.col(nodes[1]) + octahedron.x.col(nodes[2])) / 3;
    Frame at{Vec3::Zero(), random.rotation()};
    at.origin = middle - convex(a, at).x.front();
    const double distance = signed_distance(convex(a, at), convex(mesh, {}));
    if (!(distance < -1e-3)) continue;
    ++overlaps;
    double least = infinity;
    for (const auto& contact : contacts(a, at, mesh, {}, 1e-3))
      least = std::min(least, touch(contact, at, {}).gap);
    unseen += !(least < -1e-4);
  }
  CHECK(overlaps > 1000);
  CHECK(unseen == 0);
}

TEST_CASE("closed meshes that coincide overlap by their least side") {
  const Shape plate = ClosedMesh(box_surface({0.3, 0.2, 0.02}));
  for (const double shift : {0.0, 1e-12, 1e-3}) {
    const Frame at{Vec3(shift, -shift, 0)};
    double least = infinity;
    for (const auto& contact : contacts(plate, at, plate, {}, 1e-3))
      least = std::min(least, touch(contact, at, {}).gap);
    CHECK(least == Approx(-0.02));
  }
}

TEST_CASE("a ring of triangles touches nothing that stands in its middle, and rings are linked apart") {
  // 24 x 12 quadrilaterals about circles of radius 1 m and 0.3 m: the hole's radius is 0.7 m.
  constexpr int around = 24, across = 12;
  constexpr double turn = 2 * std::numbers::pi;
  TriangleMesh torus;
  torus.x.resize(3, around * across);
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double a = turn * i / around, b = turn * j / across, r = 1 + 0.3 * std::cos(b);
      torus.x.col(across * i + j) << r * std::cos(a), r * std::sin(a), 0.3 * std::sin(b);
      const auto at = [&](int m, int n) { return across * ((i + m) % around) + (j + n) % across; };
      torus.triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
      torus.triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
    }
  const Shape ring = ClosedMesh(torus);
  const Frame upright{Vec3(1, 0, 0), Eigen::AngleAxisd(turn / 4, Vec3::UnitX()).toRotationMatrix()};
  for (const bool first : {true, false}) {
    const Shape post = ClosedMesh(box_surface({0.8, 0.8, 3}));
    CHECK((first ? contacts(ring, {}, post, {}, 0.01) : contacts(post, {}, ring, {}, 0.01)).empty());
  }
  CHECK(contacts(ring, upright, ring, {}, 0.01).empty());
  double least = infinity;
  for (const auto& contact : contacts(ring, {}, ring, {}, 0.01))
    least = std::min(least, touch(contact, {}, {}).gap);
  CHECK(least < -0.1);  // on itself it overlaps
}

TEST_CASE("a mesh over a half space touches with its nodes") {
  Random random(43);
  const TriangleMesh surface = refined(shaken_octahedron(random));
  const Frame at{{0, 0, 0.5}, random.rotation()};
  std::size_t expected = 0;
  for (Eigen::Index i = 0; i < surface.x.cols(); ++i) expected += at.place(surface.x.col(i)).z() < 0.1;
  const auto found = contacts(ClosedMesh(surface), at, HalfSpace{}, {}, 0.1);
  CHECK(found.size() == expected);
  for (const auto& contact : found) {
    const Touching t = touch(contact, at, {});
    CHECK(t.gap == Approx(t.point_a.z()).margin(1e-14));
  }
}

TEST_CASE("a sphere in a valley touches both slopes") {
  // A ridge's roof, turned over: the notch of a closed surface with the profile of an M.
  const double radius = 0.2;
  TriangleMesh valley{Points(3, 10), {}};
  const std::array<Eigen::Vector2d, 5> profile{{{-1, -1}, {1, -1}, {1, 1}, {0, 0}, {-1, 1}}};
  for (int k = 0; k < 5; ++k)
    for (int end = 0; end < 2; ++end)
      valley.x.col(2 * k + end) << profile[static_cast<std::size_t>(k)].x(), end == 0 ? -2 : 2,
          profile[static_cast<std::size_t>(k)].y();
  for (int k = 0; k < 5; ++k) {
    const int i = 2 * k, j = 2 * ((k + 1) % 5);
    valley.triangles.push_back({i, j, j + 1});
    valley.triangles.push_back({i, j + 1, i + 1});
  }
  for (const auto& [i, j, k] : {std::array{0, 2, 6}, {2, 4, 6}, {0, 6, 8}}) {
    valley.triangles.push_back({k, j, i});
    valley.triangles.push_back({i + 1, j + 1, k + 1});
  }
  double volume = 0;
  for (const auto& t : valley.triangles)
    volume += valley.x.col(t[0]).head<3>().cross(valley.x.col(t[1]).head<3>()).dot(valley.x.col(t[2])) / 6;
  if (volume < 0)
    for (auto& t : valley.triangles) std::swap(t[0], t[1]);
  const Frame at{{0, 0.1, std::sqrt(2) * radius + 0.01}, Eigen::Matrix3d::Identity()};
  const auto found = contacts(Sphere{radius}, at, ClosedMesh(valley), {}, 0.05);
  REQUIRE(found.size() == 2);
  for (const auto& contact : found) {
    const Touching t = touch(contact, at, {});
    CHECK(t.gap == Approx(0.01 / std::sqrt(2)));
    CHECK(std::abs(t.normal.x()) == Approx(1 / std::sqrt(2)));
  }
}
