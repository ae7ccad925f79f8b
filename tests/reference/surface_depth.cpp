// Deformable surfaces in each other, as a judge measures them.
#include "surface_depth.h"

#include <catch2/catch.hpp>

#include "mesh.h"

using namespace pbd;
using namespace pbd::reference;

namespace {

constexpr double thickness = 0.01;  // m

using Pair = SurfaceOverlap::Kind;

/// The overlaps of a triangle in the plane z = 0 and another one.
std::vector<SurfaceOverlap> beside(const Vec3& a, const Vec3& b, const Vec3& c) {
  Points x(3, 6);
  x << Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), a, b, c;
  const std::vector<std::array<int, 3>> triangles{{0, 1, 2}, {3, 4, 5}};
  return surface_overlaps(triangles, x, thickness, 0);
}

}  // namespace

TEST_CASE("surfaces: by nodes over triangles, edges that cross, nodes beside edges, and what goes through") {
  constexpr double gap = 0.004;  // m
  const auto over = beside({0.2, 0.2, gap}, {0.2, 0.3, 1}, {0.3, 0.2, 1});
  REQUIRE(over.size() == 1);
  CHECK(over[0].kind == Pair::node_triangle);
  CHECK(over[0].depth == Approx(thickness - gap).epsilon(1e-12));
  CHECK(over[0].name() == "node and triangle of nodes 3, 0, 1, 2");

  const auto edges = beside({0.5, -0.5, gap}, {0.5, 0.5, -1 - 3 * gap}, {2, -2, 2});
  CHECK(
      std::all_of(edges.begin(), edges.end(), [](const auto& found) { return found.kind != Pair::through; }));
  const auto crossing = beside({0.5, -0.1, -gap}, {0.5, 0.1, -gap}, {0.5, 0, -1});
  REQUIRE(!crossing.empty());
  CHECK(std::any_of(crossing.begin(), crossing.end(), [&](const auto& found) {
    return found.kind == Pair::edges && std::abs(found.depth - (thickness - gap)) <= 1e-15;
  }));

  const auto aside = beside({0.5, -gap, 0}, {0.4, -1, 0}, {0.6, -1, 0});
  REQUIRE(aside.size() == 1);
  CHECK(aside[0].kind == Pair::node_edge);
  CHECK(aside[0].depth == Approx(thickness - gap).epsilon(1e-12));
  CHECK(!aside[0].crease);

  // By 0.1 m on both sides, and 0.2 m beside the nearest one of the triangle's.
  const auto through = beside({0.2, 0.3, 0.1}, {0.2, 0.3, -0.1}, {3, 3, 0.5});
  CHECK(std::count_if(through.begin(), through.end(), [](const auto& found) {
          return found.name() == "edge through triangle of nodes 3, 4, 0, 1, 2" &&
                 std::abs(found.depth - (thickness + 0.1)) <= 1e-15;
        }) == 1);
  CHECK(beside({0.2, 0.2, 0.5}, {0.3, 0.3, thickness}, {0.2, 0.2, 2}).empty());
}

TEST_CASE("surfaces: a node beside an edge counts where no triangle of both is nearer") {
  constexpr double gap = 0.004;  // m
  // A corner that is beside the edge by half the gap: of its triangle two edges cross that one.
  const auto found = beside({-gap / 2, 0.3, gap}, {1, 0.2, gap}, {1, 0.5, gap});
  const auto by_node = [](const auto& each) { return each.kind == Pair::node_edge && each.node[0] == 3; };
  CHECK(std::none_of(found.begin(), found.end(), by_node));
  CHECK(std::any_of(found.begin(), found.end(), [&](const auto& each) {
    return each.kind == Pair::edges && std::abs(each.depth - (thickness - gap)) <= 1e-15;
  }));
  // The same corner of a triangle that rises away.
  const auto away = beside({-gap / 2, 0.3, gap}, {-1, 0.2, 1}, {-1, 0.5, 1});
  CHECK(std::any_of(away.begin(), away.end(), by_node));
}

TEST_CASE("surfaces: what lies in a triangle's plane but for rounding does not go through it") {
  const auto found = beside({0.2, 0.3, 1e-17}, {0.4, 0.3, -1e-17}, {3, 3, 0.5});
  CHECK(!found.empty());  // its nodes are on the triangle
  CHECK(std::none_of(found.begin(), found.end(),
                     [](const auto& each) { return each.kind == Pair::through && each.node[0] == 3; }));
}

TEST_CASE("surfaces: a sheet that is pressed together in its plane touches itself beside its creases alone") {
  const TriangleMesh mesh = grid_sheet({10, 1}, {0.2 * 10 * thickness, 0.5});
  const auto found = surface_overlaps(mesh.triangles, mesh.x, thickness, 0);
  REQUIRE(!found.empty());
  CHECK(std::all_of(found.begin(), found.end(), [](const auto& each) { return each.crease; }));
}

TEST_CASE("surfaces: a sheet is in itself nowhere, however it lies, but where its crease is sharp") {
  TriangleMesh mesh = grid_sheet({10, 10}, {0.6, 0.5});
  for (int draw = 0; draw < 50; ++draw) {  // other roundings of what lies in one plane
    mesh.x = (Eigen::AngleAxisd(0.3 * draw, Vec3(1, 2, 3).normalized()).toRotationMatrix() * mesh.x).eval();
    mesh.x.colwise() += Vec3(0.1, -0.23, 0.17);
    CHECK(surface_overlaps(mesh.triangles, mesh.x, thickness, 0).empty());
  }
  // A node that comes down beside the edge that an edge of its own leads to.
  const std::vector<std::array<int, 3>> strip{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}};
  Points x(3, 5);
  x << Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0), Vec3(-0.002, 0.5, 0);
  const auto found = surface_overlaps(strip, x, thickness, 0);
  REQUIRE(!found.empty());
  for (const SurfaceOverlap& each : found)
    if (each.kind == Pair::node_edge) CHECK(each.crease);
}
