// Faces and the tree of boxes, which solver and judges share: beside what comparing all with all tells.
#include "polyhedron.h"

#include <catch2/catch.hpp>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "box_tree.h"

using namespace pbd;

namespace {

/// Of an uneven convex polygon, sheared at random: its caps are fans of triangles.
TriangleMesh prism(int sides, std::mt19937_64& engine) {
  const Vec3 shear = Vec3::NullaryExpr([&] { return std::uniform_real_distribution<>(-0.3, 0.3)(engine); });
  TriangleMesh mesh{Points(3, 2 * sides), {}};
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * (k + 0.3 * std::sin(9.0 * k)) / sides;
    const Vec3 low(std::cos(angle), std::sin(angle), 0);
    mesh.x.col(k) = low;
    mesh.x.col(sides + k) = low + Vec3::UnitZ() + shear;
    const int next = (k + 1) % sides;
    mesh.triangles.push_back({k, next, sides + next});
    mesh.triangles.push_back({k, sides + next, sides + k});
    if (k < 2) continue;
    mesh.triangles.push_back({0, k, k - 1});
    mesh.triangles.push_back({sides, sides + k - 1, sides + k});
  }
  return mesh;
}

/// Of a convex solid: the nodes of each plane that has all others on one side.
std::set<std::set<int>> supporting_planes(const Points& x) {
  std::set<std::set<int>> planes;
  const auto count = static_cast<int>(x.cols());
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j)
      for (int k = 0; k < j; ++k) {
        const Vec3 normal = (x.col(j) - x.col(i)).cross(x.col(k) - x.col(i));
        if (i == j || i == k || normal.norm() < 1e-6) continue;
        const Eigen::VectorXd above = (x.colwise() - x.col(i)).transpose() * normal.normalized();
        if (above.maxCoeff() > 1e-12) continue;
        std::set<int> plane;
        for (int node = 0; node < count; ++node)
          if (above[node] > -1e-12) plane.insert(node);
        planes.insert(plane);
      }
  return planes;
}

}  // namespace

// Two faces of a convex solid have two nodes in common where an edge is, and nowhere else.
TEST_CASE("faces and edges of convex solids are those of their supporting planes") {
  std::mt19937_64 engine(1);
  std::vector<TriangleMesh> meshes{box_surface({1, 2, 0.5})};
  for (const int sides : {3, 4, 5, 8, 13}) meshes.push_back(prism(sides, engine));
  for (const TriangleMesh& mesh : meshes) {
    const Polyhedron solid = plane_faces(mesh);
    std::set<std::set<int>> faces;
    std::map<std::set<int>, int> shared;
    for (const auto& face : solid.faces) {
      const auto first = solid.corners.begin() + static_cast<std::ptrdiff_t>(face.first);
      faces.emplace(first, first + static_cast<std::ptrdiff_t>(face.count));
      CHECK((face.normal.transpose() * mesh.x).maxCoeff() == Approx(face.offset).margin(1e-12));
      CHECK(face.normal.norm() == Approx(1));
    }
    const auto planes = supporting_planes(mesh.x);
    CHECK(faces == planes);
    for (const auto& plane : planes)
      for (const int a : plane)
        for (const int b : plane)
          if (a < b) ++shared[{a, b}];
    std::set<std::set<int>> edges, expected;
    for (const auto& [nodes, count] : shared)
      if (count == 2) expected.insert(nodes);
    for (const auto& edge : solid.edges) {
      edges.insert({edge.node[0], edge.node[1]});
      for (const int face : edge.face) {
        const auto& own = solid.faces[static_cast<std::size_t>(face)];
        for (const int node : edge.node)
          CHECK(own.normal.dot(mesh.x.col(node)) == Approx(own.offset).margin(1e-12));
      }
    }
    CHECK(edges == expected);
    CHECK(edges.size() == solid.edges.size());
  }
}

TEST_CASE("a tree of boxes visits each box that one intersects, once") {
  std::mt19937_64 engine(2);
  std::uniform_real_distribution<> place(0, 3);
  const auto box = [&](double size) {
    const Vec3 low(place(engine), place(engine), place(engine));
    return AxisBox(low, low + size * Vec3(place(engine), place(engine), place(engine)));
  };
  std::size_t met = 0;
  for (const int count : {0, 1, 2, 3, 50, 333}) {
    std::vector<AxisBox> boxes;
    for (int i = 0; i < count; ++i)
      boxes.push_back(i % 5 == 0 && i > 0 ? boxes.back() : box(0.2));  // some alike
    BoxTree tree;
    tree.build(boxes);
    for (int asked = 0; asked < 50; ++asked) {
      const AxisBox around = box(0.5);
      std::multiset<int> found, expected;
      tree.find(around, [&](int i) { found.insert(i); });
      for (int i = 0; i < count; ++i) {
        const AxisBox& own = boxes[static_cast<std::size_t>(i)];
        if ((own.min().array() <= around.max().array()).all() &&
            (around.min().array() <= own.max().array()).all())
          expected.insert(i);
      }
      CHECK(found == expected);
      met += found.size();
    }
  }
  CHECK(met > 100);
}
