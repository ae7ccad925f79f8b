#include "scenes/mesh_file.h"

#include <algorithm>

#include "error.h"
#include "scenes/mesh_readers.h"

namespace pbdcheck {
namespace {

[[noreturn]] void refuse_extension(const std::filesystem::path& file, std::string_view allowed) {
  throw pbd::SetupError(file.string(), "extension `" + file.extension().string() + "`", allowed);
}

Elements<4> read_tets(const std::filesystem::path& file) {
  const auto extension = file.extension();
  if (extension == ".msh") return read_msh<4>(file);
  if (extension == ".node" || extension == ".ele") return read_tetgen(file);
  refuse_extension(file, "a mesh of tetrahedra, .msh, .node or .ele");
}

Elements<3> read_triangles(const std::filesystem::path& file) {
  const auto extension = file.extension();
  if (extension == ".msh") return read_msh<3>(file);
  if (extension == ".obj") return read_obj(file);
  if (extension == ".off") return read_off(file);
  refuse_extension(file, "a mesh of triangles, .msh, .obj or .off");
}

/// The positions the elements use, in the file's order; renumbers the elements.
template <std::size_t K>
pbd::Points used_nodes(Elements<K>& found) {
  std::vector<int> index(found.x.size(), -1);
  for (const auto& element : found.nodes)
    for (const int node : element) index[static_cast<std::size_t>(node)] = 0;
  pbd::Points x(3, std::count(index.begin(), index.end(), 0));
  int used = 0;
  for (std::size_t i = 0; i < index.size(); ++i)
    if (index[i] == 0) {
      index[i] = used;
      x.col(used++) = pbd::Vec3::Map(found.x[i].data());
    }
  for (auto& element : found.nodes)
    for (int& node : element) node = index[static_cast<std::size_t>(node)];
  return x;
}

}  // namespace

pbd::TetMesh read_tet_mesh(const std::filesystem::path& file) {
  auto found = read_tets(file);
  if (found.nodes.empty()) throw pbd::SetupError(file.string(), "no tetrahedra", "a mesh with tetrahedra");
  pbd::Points x = used_nodes(found);
  return {std::move(x), std::move(found.nodes)};
}

pbd::TriangleMesh read_triangle_mesh(const std::filesystem::path& file) {
  auto found = read_triangles(file);
  if (found.nodes.empty()) throw pbd::SetupError(file.string(), "no triangles", "a mesh with triangles");
  pbd::Points x = used_nodes(found);
  return {std::move(x), std::move(found.nodes)};
}

pbd::Points read_mesh_nodes(const std::filesystem::path& file) {
  const auto found = read_triangles(file);
  pbd::Points x(3, static_cast<Eigen::Index>(found.x.size()));
  for (std::size_t i = 0; i < found.x.size(); ++i)
    x.col(static_cast<Eigen::Index>(i)) = pbd::Vec3::Map(found.x[i].data());
  return x;
}

}  // namespace pbdcheck
