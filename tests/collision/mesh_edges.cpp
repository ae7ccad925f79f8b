#include <catch2/catch.hpp>

#include "contact_shapes.h"
#include "hollow_meshes.h"
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
  const auto kind = GENERATE(as<std::string>(), "hull", "mesh", "refined mesh");
  const TriangleMesh on_edges = on_edge(kind == "refined mesh" ? refined(cube) : cube, 1);
  const Shape wedge = kind == "hull" ? Shape(ConvexHull(on_edges)) : Shape(ClosedMesh(on_edges));
  const double across = GENERATE(0.0, 0.25);     // m, from the middle of the wedge
  const double along = GENERATE(0.0, 0.5, 0.3);  // m, from the middle of the ridge
  const double gap = GENERATE(0.0, 1e-17, -1e-15, 1e-12, -1e-12, 1e-7, -1e-7, -1.5e-6, -2e-6, -3e-6, 1e-4);
  const double yaw = GENERATE(0.0, 0.3);
  const Frame at{Vec3(across, along, 2 + gap), Eigen::AngleAxisd(yaw, Vec3::UnitZ()).toRotationMatrix()};
  for (const bool first : {true, false}) {
    const auto found = first ? contacts(wedge, at, ridge, {}, 1e-3) : contacts(ridge, {}, wedge, at, 1e-3);
    CHECK(!found.empty());
    for (const auto& contact : found) {
      const Touching t = first ? touch(contact, at, {}) : touch(contact, {}, at);
      CHECK(std::abs(t.normal.z()) > 1 - 1e-12);
      CHECK(t.gap == Approx(gap).margin(1e-14));
    }
  }
}

// The surface rises from such a node beside each of its edges, which both hold what lies across the node: a
// block's edge that comes out of the hollow and goes on over the top.
TEST_CASE("an edge across a mesh's saddle touches both edges that it lies across") {
  const TriangleMesh profile = angle_profile();
  const Shape mesh = ClosedMesh(profile);
  const Vec3 saddle(0, 0, 1), along = Vec3(1, 1, -1).normalized(), away = Vec3(1, 1, 2).normalized();
  REQUIRE((profile.x.col(9) - saddle).norm() == 0);
  const auto kind = GENERATE(as<std::string>(), "box", "hull", "mesh");
  const double gap = GENERATE(0.0, 1e-15, -1e-15, 1e-12, -1e-12), shift = GENERATE(0.0, 0.1);
  const TriangleMesh cube = box_surface({1, 1, 1});
  const Shape block = kind == "box"    ? Shape(Box{Vec3::Ones()})
                      : kind == "hull" ? Shape(ConvexHull(cube))
                                       : Shape(ClosedMesh(cube));
  const Vec3 beside = along.cross(away), one = (away - beside).normalized(),
             two = (away + beside).normalized();
  Frame at;
  at.rotation << along, one, two;
  at.origin = saddle + (one + two) / 2 + shift * along + gap * away;
  for (const bool first : {true, false}) {
    INFO(kind << ", gap " << gap << ", first " << first);
    const auto found = first ? contacts(block, at, mesh, {}, 1e-3) : contacts(mesh, {}, block, at, 1e-3);
    for (const Vec3& edge : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY())}) {
      const Vec3 normal = along.cross(edge).normalized();
      const auto holds = [&](const ContactPoint& contact) {
        const Touching t = first ? touch(contact, at, {}) : touch(contact, {}, at);
        return std::abs(t.normal.dot(normal)) > 1 - 1e-12 && std::abs(t.gap) < 1e-9;
      };
      CHECK(std::any_of(found.begin(), found.end(), holds));
    }
  }
}
