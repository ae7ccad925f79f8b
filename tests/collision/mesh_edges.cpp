#include <catch2/catch.hpp>

#include "contact_shapes.h"
#include "refined.h"

using namespace pbd;
using namespace pbd::test;

TEST_CASE("an edge that touches a mesh's edge is felt where that edge has a node, too") {
  // Cubes on their edges, without rounding: the ridge has nodes at y = -1, 0, 1 m.
  const auto on_edge = [](TriangleMesh mesh, int axis) {
    const Eigen::RowVectorXd across = mesh.x.row(axis), up = mesh.x.row(2);
    mesh.x.row(axis) = (across - up) / 2;
    mesh.x.row(2) = (across + up) / 2;
    return mesh;
  };
  const TriangleMesh cube = box_surface({2, 2, 2});
  const Shape ridge = ClosedMesh(on_edge(refined(cube), 0));
  const bool hull = GENERATE(true, false);
  const Shape wedge = hull ? Shape(ConvexHull(on_edge(cube, 1))) : Shape(ClosedMesh(on_edge(cube, 1)));
  const double along = GENERATE(0.0, 0.5, 0.3);  // m, from the middle of the ridge
  const double gap = GENERATE(0.0, 1e-17, -1e-15, 1e-12, -1e-12, 1e-7, -1e-7, 1e-4);
  const double yaw = GENERATE(0.0, 0.3);
  const Frame at{Vec3(0.25, along, 2 + gap), Eigen::AngleAxisd(yaw, Vec3::UnitZ()).toRotationMatrix()};
  const auto found = contacts(wedge, at, ridge, {}, 1e-3);
  CHECK(!found.empty());
  for (const auto& contact : found) {
    const Touching t = touch(contact, at, {});
    CHECK(std::abs(t.normal.z()) > 1 - 1e-12);
    CHECK(t.gap == Approx(gap).margin(1e-14));
  }
}
