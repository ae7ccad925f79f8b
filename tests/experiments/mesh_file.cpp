#include "mesh_file.h"

#include <catch2/catch.hpp>

#include "program.h"

using namespace pbdcheck;
using namespace pbdcheck::test;
using Tets = std::vector<std::array<int, 4>>;
using Triangles = std::vector<std::array<int, 3>>;

namespace {

// Nodes 10 (unused), 20, 30, 40, 50; a line, a triangle and a tetrahedron.
const std::string msh2 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
1
3 1 "body"
$EndPhysicalNames
$Nodes
5
10 9 9 9
20 0 0 0
30 1 0 0
40 0 1 0
50 0 0 1
$EndNodes
$Elements
3
1 1 2 0 1 20 30
2 2 2 0 1 20 30 40
3 4 2 0 1 20 30 40 50
$EndElements
)";
const std::string msh4 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$Nodes
2 5 10 50
0 1 0 1
10
9 9 9
3 1 0 4
20
30
40
50
0 0 0
1 0 0
0 1 0
0 0 1
$EndNodes
$Elements
3 3 1 3
1 1 1 1
1 20 30
2 1 2 1
2 20 30 40
3 1 4 1
3 20 30 40 50
$EndElements
)";

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const auto at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), with);
}

}  // namespace

TEST_CASE("Gmsh files of both versions give their tetrahedra and triangles, unused nodes dropped") {
  for (const auto& text : {msh2, msh4}) {
    const TemporaryFolder folder;
    const auto file = folder.write("mesh.msh", text);
    const auto solid = read_tet_mesh(file);
    CHECK(solid.tets == Tets{{0, 1, 2, 3}});
    REQUIRE(solid.x.cols() == 4);
    CHECK(solid.x.col(1) == pbd::Vec3(1, 0, 0));
    CHECK(solid.x.col(3) == pbd::Vec3(0, 0, 1));
    const auto surface = read_triangle_mesh(file);
    CHECK(surface.triangles == Triangles{{0, 1, 2}});
    CHECK(surface.x.cols() == 3);
  }
}

TEST_CASE("TetGen files are read from 0 or from 1, comments and attributes skipped") {
  const TemporaryFolder folder;
  folder.write(
      "a.node",
      "# made by hand\n4 3 1 1\n1 0 0 0 7 0 # attribute, marker\n2 1 0 0 7 0\n\n3 0 1 0 7 0\n4 0 0 1 7 1\n");
  folder.write("a.ele", "1 4 1\n1 1 2 3 4 9\n");
  folder.write("b.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n");
  folder.write("b.ele", "1 4 0\n0 0 1 2 3\n");
  for (const auto* name : {"a.node", "a.ele", "b.node"}) {
    const auto mesh = read_tet_mesh(folder.path / name);
    CHECK(mesh.tets == Tets{{0, 1, 2, 3}});
    CHECK(mesh.x.col(2) == pbd::Vec3(0, 1, 0));
  }
}

TEST_CASE("OBJ and OFF surfaces are read") {
  const TemporaryFolder folder;
  const auto obj = folder.write(
      "s.obj",
      "# square\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1/1/1 2//1 3\nf -4 -2 -1\n");
  const auto off = folder.write("s.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
  for (const auto& file : {obj, off}) {
    const auto mesh = read_triangle_mesh(file);
    CHECK(mesh.triangles == Triangles{{0, 1, 2}, {0, 2, 3}});
    CHECK(mesh.x.col(2) == pbd::Vec3(1, 1, 0));
  }
}

TEST_CASE("broken meshes are refused with file and line") {
  const std::vector<std::array<std::string, 3>> broken{
      {"a.msh", replaced(msh2, "2.2 0 8", "2.2 1 8"), "a.msh:2: got a binary mesh"},
      {"a.msh", replaced(msh2, "2.2", "4.0"), "a.msh:2: got MSH version 4.0"},
      {"a.msh", replaced(msh2, "30 1 0 0", "20 1 0 0"), "a.msh:12: got node 20 twice"},
      {"a.msh", replaced(msh2, "30 1 0 0", "30 1 0 nan"), "a.msh:12: got `nan`"},
      {"a.msh", replaced(msh2, "30 1 0 0", "30 1 0"), "a.msh:12: got 3 words"},
      {"a.msh", replaced(msh2, "30 40 50\n", "30 40 60\n"), "a.msh:20: got node 60"},
      {"a.msh", replaced(msh2, "30 40 50\n", "30 40 40\n"), "a.msh:20: got node 40 twice"},
      {"a.msh", msh4.substr(0, msh4.find("0 1 0\n0 0 1")), "got the end of the file"},
      {"a.msh", replaced(msh4, "3 20 30 40 50", "3 20 30 40 x"), "a.msh:26: got `x`"},
      {"a.msh", "hello\n", "a.msh:1: got `hello`; allowed: $MeshFormat"},
      {"a.off", "OFF\n1 1 0\n0 0 0\n4 0 0 0 0\n", "a.off:4: got 4 nodes in a face"},
      {"a.obj", "v 0 0 0\nf 1 2 3\n", "a.obj:2: got vertex 2"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 1\n", "a.obj:4: got a face of 4 nodes"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nf 1 2 2\n", "a.obj:3: got a face with a vertex twice"},
      {"a.obj", "v 0 zero 0\n", "a.obj:1: got `zero`"},
      {"a.stl", "solid\n", "a.stl: got extension `.stl`"},
  };
  for (const auto& [name, text, message] : broken) {
    INFO(text);
    const TemporaryFolder folder;
    const auto file = folder.write(name, text);
    CHECK_THROWS_WITH(file.extension() == ".msh" ? (void)read_tet_mesh(file) : (void)read_triangle_mesh(file),
                      Catch::Contains(message));
  }
}

TEST_CASE("a mesh without the elements that are asked for, or without its second file, is refused") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(read_tet_mesh(folder.write("a.off", "OFF 1 0 0\n0 0 0\n")),
                    Catch::Contains("no tetrahedra"));
  folder.write("b.node", "0 3 0 0\n");
  CHECK_THROWS_WITH(read_tet_mesh(folder.path / "b.node"),
                    Catch::Contains("b.ele") && Catch::Contains("no such file"));
}
