#include "boundary.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <map>

using namespace pbd;

// The faces of a box of a x b x c bricks are two triangles a rectangle; by Gauss' theorem the volume is the
// sum of x0 . (x1 x x2) / 6.
TEST_CASE("the boundary of a box is closed, seen from outside, and encloses its volume") {
  const Vec3 size(2, 0.5, 0.25);
  const TetMesh mesh = kuhn_grid({4, 3, 2}, size, {1, 2, 3});
  const auto faces = boundary(mesh);
  CHECK(faces.size() == 4 * (4 * 3 + 3 * 2 + 2 * 4));
  double volume = 0;
  std::map<std::array<int, 2>, int> edge;
  for (const auto& [i, j, k] : faces) {
    volume += mesh.x.col(i).dot(Vec3(mesh.x.col(j)).cross(Vec3(mesh.x.col(k)))) / 6;
    for (const auto& [a, b] : {std::array{i, j}, std::array{j, k}, std::array{k, i}}) ++edge[{a, b}];
  }
  CHECK(volume == Approx(size.prod()).epsilon(1e-13));
  for (const auto& [ends, count] : edge) {
    CHECK(count == 1);
    CHECK(edge.contains({ends[1], ends[0]}));
  }
}
