#include "studies/cost/sized_scenes.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "collision/generate.h"
#include "harness/files.h"
#include "scenes/mesh_file.h"

namespace pbdcheck {

using namespace pbd;

namespace {

std::filesystem::path file_of(std::string_view name) {
  return scenes_folder() / fmt::format("{}.toml", name);
}

/// As --set takes it.
template <class T>
std::string list_of(std::string_view key, const std::array<T, 3>& v) {
  return fmt::format("{}=[{}, {}, {}]", key, v[0], v[1], v[2]);
}

using Copies = std::array<int, 3>;  // along x, y and z

constexpr std::array<Copies, 7> box_copies{
    {{2, 2, 4}, {4, 2, 4}, {4, 4, 4}, {5, 5, 5}, {10, 5, 5}, {10, 10, 5}, {10, 10, 10}}};
constexpr std::array<Copies, 7> bunny_copies{
    {{1, 1, 1}, {1, 1, 1}, {1, 1, 3}, {1, 1, 5}, {2, 1, 5}, {2, 2, 5}, {4, 2, 5}}};

const Copies& copies_at(const std::array<Copies, 7>& all, int level) {
  return all[static_cast<std::size_t>(level - least_level)];
}

/// Of copies that stand around the middle.
double first_of(int count, double spacing) {
  return -spacing * (count - 1) / 2;
}

SizedScene boxes(int level) {
  constexpr double spacing = 0.42, lowest = 0.3;  // m, as in the file
  const Copies& copies = copies_at(box_copies, level);
  SizedScene scene{read_scene_file(
      file_of("boxes_on_ground"),
      {list_of("rigid_body.1.copies", copies),
       list_of("rigid_body.1.position_m",
               std::array{first_of(copies[0], spacing), first_of(copies[1], spacing), lowest})})};
  scene.size = copies[0] * copies[1] * copies[2];
  return scene;
}

SizedScene bunnies(int level) {
  constexpr double cell = 1.0 / 40, lowest = 0.1, spacing = 0.35;  // m, as in the file
  const int cells = static_cast<int>(std::lround(std::sqrt(std::exp2(level)) / cell));
  const double side = cells * cell;
  const Copies& copies = copies_at(bunny_copies, level);
  const std::array<double, 3> apart{side / copies[0], side / copies[1], spacing};
  SizedScene scene{read_scene_file(
      file_of("bunnies_on_cloth"),
      {fmt::format("cloth.0.cells=[{0}, {0}]", cells), fmt::format("cloth.0.size_m=[{0}, {0}]", side),
       list_of("cloth.0.translation_m", std::array{-side / 2, -side / 2, 0.0}),
       list_of("rigid_body.1.copies", copies), list_of("rigid_body.1.spacing_m", apart),
       list_of("rigid_body.1.position_m",
               std::array{first_of(copies[0], apart[0]), first_of(copies[1], apart[1]), lowest})})};
  scene.size = cells * cells;
  return scene;
}

/// Cubes of six tetrahedra each whose middles are inside.
TetMesh filled(const TriangleMesh& surface, double cell) {
  const ClosedMesh closed(surface);
  const Vec3 low = surface.x.rowwise().minCoeff(), sides = surface.x.rowwise().maxCoeff() - low;
  const Eigen::Array3i count = (sides.array() / cell).ceil().cast<int>();
  const TetMesh grid = kuhn_grid({count[0], count[1], count[2]}, count.cast<double>() * cell, low);
  CollisionScratch scratch;
  std::vector<ContactPoint> found;
  std::map<int, int> number;
  TetMesh mesh;
  constexpr std::size_t a_cube = 6;
  for (std::size_t first = 0; first < grid.tets.size(); first += a_cube) {
    const auto& corners = grid.tets[first];  // its first and last are the ends of the cube's diagonal
    const Vec3 middle = (grid.x.col(corners.front()) + grid.x.col(corners.back())) / 2;
    if (!is_at(closed, {}, middle, 0, scratch, found)) continue;
    for (std::size_t k = first; k < first + a_cube; ++k) {
      auto tet = grid.tets[k];
      for (int& node : tet) node = number.try_emplace(node, static_cast<int>(number.size())).first->second;
      mesh.tets.push_back(tet);
    }
  }
  mesh.x.resize(3, static_cast<Eigen::Index>(number.size()));
  for (const auto& [of_grid, own] : number) mesh.x.col(own) = grid.x.col(of_grid);
  return mesh;
}

/// Of Gmsh, version 2.2.
std::string text_of(const TetMesh& mesh) {
  std::string text = fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", mesh.x.cols());
  for (Eigen::Index i = 0; i < mesh.x.cols(); ++i)
    text += fmt::format("{} {} {} {}\n", i + 1, mesh.x(0, i), mesh.x(1, i), mesh.x(2, i));
  text += fmt::format("$EndNodes\n$Elements\n{}\n", mesh.tets.size());
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    const auto& [a, b, c, d] = mesh.tets[i];
    text += fmt::format("{} 4 0 {} {} {} {}\n", i + 1, a + 1, b + 1, c + 1, d + 1);
  }
  return text + "$EndElements\n";
}

SizedScene cow(int level, const std::filesystem::path& directory) {
  constexpr double cell = 1.0 / 16;  // m, of the mesh of the file
  const TetMesh mesh =
      filled(read_triangle_mesh(scenes_folder() / "meshes/cow.off"), cell / std::cbrt(std::exp2(level)));
  const std::filesystem::path file = directory / fmt::format("cow_{}.msh", mesh.tets.size());
  write_file(file, text_of(mesh));
  SizedScene scene{
      read_scene_file(file_of("flexible_cow"),
                      {fmt::format("solid.0.file=\"{}\"", std::filesystem::absolute(file).string())})};
  scene.size = std::ssize(mesh.tets);
  return scene;
}

}  // namespace

SizedScene sized_scene(std::string_view name, int level, const std::filesystem::path& directory) {
  if (name == "boxes_on_ground") return boxes(level);
  return name == "bunnies_on_cloth" ? bunnies(level) : cow(level, directory);
}

}  // namespace pbdcheck
