#include "scenes/mesh_file.h"

#include <sys/stat.h>

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
  text.replace(at, what.size(), with);
  return text;
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

namespace {

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
/// Name, text, and a part of the refusal.
/// Made where a test runs: `replaced` checks its text.
std::vector<std::array<std::string, 3>> broken_files() {
  return {
      {"a.msh", replaced(msh2, "2.2 0 8", "2.2 1 8"), "a.msh:2: got a binary mesh"},
      {"a.msh", replaced(msh2, "2.2", "4.0"), "a.msh:2: got MSH version 4.0"},
      {"a.msh", replaced(msh2, "30 1 0 0", "20 1 0 0"), "a.msh:12: got node 20 twice"},
      {"a.msh", replaced(msh2, "30 1 0 0", "30 1 0 nan"), "a.msh:12: got `nan`"},
      {"a.msh", replaced(msh2, "30 1 0 0", "30 1 0"), "a.msh:12: got 3 words; allowed: 4: a node's number"},
      {"a.msh", replaced(msh2, "30 1 0 0", "30 1 0 0 0"), "a.msh:12: got 5 words"},
      {"a.msh", replaced(msh2, "30 40 50\n", "30 40 60\n"), "a.msh:20: got node 60"},
      {"a.msh", replaced(msh2, "30 40 50\n", "30 40 40\n"), "a.msh:20: got node 40 twice"},
      {"a.msh", replaced(msh2, "30 40 50\n", "30 40 50 20\n"), "a.msh:20: got 10 words"},
      {"a.msh", replaced(msh2, "30 40 50\n", "30 40 50junk\n"),
       "a.msh:20: got `50junk`; allowed: an integer"},
      {"a.msh", replaced(msh2, "$EndElements\n", "4 4 2 0 1 50 40 30 20\n$EndElements\n"),
       "a.msh:21: got `4`; allowed: $EndElements"},
      {"a.msh",
       replaced(replaced(msh2, "$EndElements\n", "4 4 2 0 1 50 40 30 20\n$EndElements\n"), "\n3\n1 1",
                "\n4\n1 1"),
       "a.msh:21: got an element of the same nodes as one before"},
      {"a.msh", replaced(msh2, "$EndNodes\n", ""), "a.msh:15: got `$Elements`; allowed: $EndNodes"},
      {"a.msh", replaced(msh2, "$EndElements\n", ""),
       "a.msh:20: got the end of the file; allowed: $EndElements"},
      {"a.msh", replaced(msh2, "$EndPhysicalNames\n", ""),
       "got the end of the file; allowed: $EndPhysicalNames"},
      {"a.msh", replaced(msh2, "$EndMeshFormat\n", ""),
       "a.msh:3: got `$PhysicalNames`; allowed: $EndMeshFormat"},
      {"a.msh", replaced(msh2, "3 4 2 0 1", "3 5 2 0 1"),
       "a.msh:20: got element type 5, hexahedron; allowed: type 4"},
      {"a.msh", replaced(msh2, "3 4 2 0 1", "3 11 2 0 1"),
       "a.msh:20: got element type 11, second-order tetra"},
      {"a.msh", replaced(msh2, "3 4 2 0 1", "3 77 2 0 1"), "a.msh:20: got element type 77; allowed: type 4"},
      {"a.msh", replaced(msh4, "3 1 4 1", "3 1 6 1"), "a.msh:25: got element type 6, prism; allowed: type 4"},
      {"a.msh", replaced(msh4, "2 5 10 50", "2 6 10 50"), "a.msh:17: got 5 entries in the section's blocks"},
      {"a.msh", replaced(msh4, "3 3 1 3", "3 4 1 3"), "a.msh:26: got 3 entries in the section's blocks"},
      {"a.msh", replaced(msh4, "20\n30\n", "20 30\n"), "a.msh:10: got 2 words"},
      {"a.msh", std::string("\0\1\2\3", 4), "a.msh:1: got binary data; allowed: a text file"},
      {"a.msh", "", "a.msh: got the end of the file; allowed: $MeshFormat"},
      {"a.msh", msh4.substr(0, msh4.find("0 1 0\n0 0 1")), "got the end of the file"},
      {"a.msh", replaced(msh4, "3 20 30 40 50", "3 20 30 40 x"), "a.msh:26: got `x`"},
      {"a.msh", "hello\n", "a.msh:1: got `hello`; allowed: $MeshFormat"},
      {"a.off", "OFF\n1 1 0\n0 0 0\n4 0 0 0 0\n", "a.off:4: got 4 nodes in a face"},
      {"a.obj", "v 0 0 0\nf 1 2 3\n", "a.obj:2: got node 2"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 1\n", "a.obj:4: got a face of 4 nodes"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nf 1 2 2\n", "a.obj:3: got node 2 twice"},
      {"a.obj", triangle + "f 1.5 2 3\n", "a.obj:5: got `1.5`; allowed: an integer"},
      {"a.obj", triangle + "f 1 2junk 3\n", "a.obj:5: got `2junk`"},
      {"a.obj", triangle + "f 1/x 2 3\n", "a.obj:5: got `x`"},
      {"a.obj", triangle + "f -4 2 3\n", "a.obj:5: got node -4"},
      {"a.obj", triangle + "f 3 1 2\n", "a.obj:5: got an element of the same nodes"},
      {"a.obj", triangle + "faces\n", "a.obj:5: got `faces`; allowed: v or f"},
      {"a.obj", "v 0 0 0 1 1 1 1 1\n", "a.obj:1: got 9 words"},
      {"a.obj", "v\n", "a.obj:1: got 1 word; "},
      {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 2 1 0\n", "a.off:7: got `3`; allowed: the end"},
      {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0 5\n3 0 1 2\n",
       "a.off:5: got 4 words; allowed: 3: x, y, z of a vertex"},
      {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 red\n", "a.off:6: got `red`; allowed: a number"},
      {"a.obj", "v 0 zero 0\n", "a.obj:1: got `zero`"},
      {"a.stl", "solid\n", "a.stl: got extension `.stl`"},
  };
}

}  // namespace

TEST_CASE("broken meshes are refused with file and line") {
  for (const auto& [name, text, message] : broken_files()) {
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
                    Catch::Contains("a.off: got extension `.off`; allowed: a mesh of tetrahedra"));
  CHECK_THROWS_WITH(read_tet_mesh(folder.write("a.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n")),
                    Catch::Contains("a.msh: got no tetrahedra"));
  folder.write("b.node", "0 3 0 0\n");
  CHECK_THROWS_WITH(read_tet_mesh(folder.path / "b.node"),
                    Catch::Contains("b.ele") && Catch::Contains("no such file"));
}

TEST_CASE("TetGen files with more entries or words than they announce, or of second order, are refused") {
  const std::string node = "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n";
  const std::string ele = "1 4 0\n0 0 1 2 3\n";
  const std::vector<std::array<std::string, 3>> broken{
      {node + "4 1 1 1\n", ele, "a.node:6: got `4`; allowed: the end of the file"},
      {replaced(node, "0 0 1\n", "0 0 1 1\n"), ele, "a.node:5: got 5 words"},
      {node, ele + "1 0 1 2 3\n", "a.ele:3: got `1`; allowed: the end of the file"},
      {node, "2 4 0\n0 0 1 2 3\n1 1 0 2 3\n", "a.ele:3: got an element of the same nodes"},
      {node, "1 4 0\n0 0 1 2 3 9\n", "a.ele:2: got 6 words"},
      {node, "1 10 0\n", "a.ele:1: got 10 nodes per tetrahedron; allowed: 4 (tetgen without -o2)"}};
  for (const auto& [nodes, elements, message] : broken) {
    const TemporaryFolder folder;
    folder.write("a.ele", elements);
    CHECK_THROWS_WITH(read_tet_mesh(folder.write("a.node", nodes)), Catch::Contains(message));
  }
}

TEST_CASE("a byte order mark before a mesh is skipped") {
  const TemporaryFolder folder;
  CHECK(read_tet_mesh(folder.write("a.msh", "\xEF\xBB\xBF" + msh2)).tets.size() == 1);
}

TEST_CASE("what is no regular file is refused by what it is") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path / "folder.obj");
  std::filesystem::create_symlink("loop.obj", folder.path / "loop.obj");
  REQUIRE(mkfifo((folder.path / "fifo.obj").c_str(), 0600) == 0);
  const std::vector<std::pair<std::string, std::string>> reasons{
      {"folder.obj", "got a folder"}, {"loop.obj", "symbolic links"}, {"fifo.obj", "got no regular file"}};
  for (const auto& [name, reason] : reasons)
    CHECK_THROWS_WITH(read_triangle_mesh(folder.path / name),
                      Catch::Contains(name + ": got") && Catch::Contains(reason));
}
