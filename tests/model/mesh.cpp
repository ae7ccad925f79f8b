#include "mesh.h"

#include <Eigen/Geometry>

#include <catch2/catch.hpp>
#include <numeric>

#include "error.h"
#include "validate.h"

using namespace pbd;

TEST_CASE("a Kuhn grid fills its box and its lumped masses weigh what the box weighs") {
  const Vec3 size(2, 0.5, 0.25);
  Scene scene;
  add_solid(scene, kuhn_grid({4, 3, 2}, size), 1000, {}, Strain::green);
  const auto& solid = std::get<TetStrain>(scene.effects.at(0));
  CHECK(solid.node.size() == 6 * 4 * 3 * 2);
  double volume = 0;
  for (const auto& rest : solid.rest) volume += tet_volume(rest);
  CHECK(volume == Approx(size.prod()).epsilon(1e-14));
  CHECK(std::accumulate(scene.mass.begin(), scene.mass.end(), 0.0) ==
        Approx(1000 * size.prod()).epsilon(1e-14));
}

TEST_CASE("an inverted and a flat tetrahedron are refused with their index") {
  TetMesh mesh = kuhn_grid({1, 1, 1}, Vec3::Ones());
  Scene scene;
  SECTION("inverted") {
    std::swap(mesh.tets[4][0], mesh.tets[4][1]);
    CHECK_THROWS_WITH(add_solid(scene, mesh, 1000, {}, Strain::green), Catch::Contains("tetrahedron 4"));
  }
  SECTION("flat") {
    mesh.tets[2] = {0, 1, 2, 3};
    CHECK_THROWS_WITH(add_solid(scene, mesh, 1000, {}, Strain::green), Catch::Contains("tetrahedron 2"));
  }
}

TEST_CASE("bending refuses triangles whose normals disagree and edges of three triangles, naming them") {
  TriangleMesh mesh = grid_sheet({2, 1}, {1, 1});
  CHECK(sheet_bending(mesh, 0, 1).node.size() == 3);
  SECTION("turned over") {
    std::swap(mesh.triangles[2][0], mesh.triangles[2][1]);
    CHECK_THROWS_WITH(sheet_bending(mesh, 0, 1), Catch::Contains("triangles 2 3: got the same direction") &&
                                                     Catch::Contains("nodes 1 and 5"));
  }
  SECTION("a third one") {
    mesh.triangles.push_back({0, 4, 5});
    CHECK_THROWS_WITH(sheet_bending(mesh, 0, 1), Catch::Contains("triangles 0 1 4: got all at the edge") &&
                                                     Catch::Contains("nodes 0 and 4"));
  }
}

TEST_CASE("an anchor on a node of infinite mass is refused with its index") {
  Scene scene;
  add_node(scene, Vec3::Zero(), 1);
  add_node(scene, Vec3::UnitX(), infinity);
  scene.effects.emplace_back(Anchor{.node = {0}, .target = {Vec3::Zero()}, .compliance = {0}});
  CHECK_NOTHROW(validate(scene));
  std::get<Anchor>(scene.effects[0]).node[0] = 1;
  CHECK_THROWS_WITH(validate(scene), Catch::Contains("effects[0] anchor node[0]: got 1, of infinite mass"));
}

TEST_CASE("a set-up error is one short line, whatever the file holds") {
  const std::string message = SetupError("where", "\x1b[31m\n" + std::string(1000, 'x'), "less").what();
  CHECK(message.size() < 300);
  CHECK_THAT(message, Catch::StartsWith("where: got ?[31m?xx") && Catch::EndsWith("xx...; allowed: less"));
}

TEST_CASE("a dihedral angle is zero when flat, and its sign follows the convention of Bending") {
  Eigen::Matrix<double, 3, 4> hinge;
  hinge << 0, 0, -1, 1,  //
      0, 1, 0.5, 0.5,    //
      0, 0, 0, 0;
  CHECK(dihedral_angle(hinge) == Approx(0).margin(1e-15));
  const double angle = 0.3;
  hinge.col(3) = Vec3(std::cos(angle), 0.5, std::sin(angle));  // rotates the second wing about the edge
  CHECK(std::abs(dihedral_angle(hinge)) == Approx(angle).epsilon(1e-14));
  const Vec3 e(0, 1, 0), a = e.cross(hinge.col(2)), b = (-e).cross(Vec3(hinge.col(3) - e));
  CHECK(dihedral_angle(hinge) * a.cross(b).dot(e) > 0);
}
