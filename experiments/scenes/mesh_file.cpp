#include "mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "error.h"
#include "lines.h"

namespace pbdcheck {
namespace {

constexpr std::int64_t msh_triangle = 2;
constexpr std::int64_t msh_tetrahedron = 4;

/// What a file holds, nodes by position in `x` and elements by such positions.
struct Elements {
  std::vector<std::array<double, 3>> x;
  std::unordered_map<std::int64_t, int> index_of;  // of a node's number in the file
  std::vector<std::array<int, 4>> tets;
  std::vector<std::array<int, 3>> triangles;

  void add_node(const Lines& lines, std::int64_t number, const std::array<double, 3>& position) {
    if (!index_of.emplace(number, static_cast<int>(x.size())).second)
      lines.refuse(fmt::format("node {} twice", number), "each node once");
    x.push_back(position);
  }

  /// The K nodes named by the words from `first` on.
  template <std::size_t K>
  std::array<int, K> nodes(const Lines& lines, std::size_t first) const {
    std::array<int, K> found{};
    for (std::size_t i = 0; i < K; ++i) {
      const auto number = lines.integer(first + i);
      const auto entry = index_of.find(number);
      if (entry == index_of.end()) lines.refuse(fmt::format("node {}", number), "a node of this file");
      found[i] = entry->second;
      if (std::count(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(i), found[i]) > 0)
        lines.refuse(fmt::format("node {} twice in an element", number), "different nodes");
    }
    return found;
  }

  void add_element(const Lines& lines, std::int64_t type, std::size_t first) {
    if (type == msh_triangle) triangles.push_back(nodes<3>(lines, first));
    if (type == msh_tetrahedron) tets.push_back(nodes<4>(lines, first));
  }
};

std::size_t count(const Lines& lines, std::size_t index) {
  const auto value = lines.integer(index);
  if (value < 0) lines.refuse(fmt::format("{}", value), "a count >= 0");
  return static_cast<std::size_t>(value);
}

bool read_msh_format(Lines& lines) {
  lines.need_next("the line after $MeshFormat");
  const std::string version = lines.words()[0];
  if (lines.integer(1) != 0) lines.refuse("a binary mesh", "an ASCII one (gmsh -format msh41 -bin 0)");
  if (version != "2.2" && version != "4.1") lines.refuse("MSH version " + version, "2.2 or 4.1");
  return version == "4.1";
}

void read_msh2_nodes(Lines& lines, Elements& found) {
  lines.need_next("the number of nodes");
  for (std::size_t left = count(lines, 0); left > 0; --left) {
    lines.need_next("a node");
    found.add_node(lines, lines.integer(0), lines.position(1));
  }
}

void read_msh2_elements(Lines& lines, Elements& found) {
  lines.need_next("the number of elements");
  for (std::size_t left = count(lines, 0); left > 0; --left) {
    lines.need_next("an element");
    found.add_element(lines, lines.integer(1), 3 + count(lines, 2));
  }
}

void read_msh4_nodes(Lines& lines, Elements& found) {
  lines.need_next("the number of node blocks");
  for (std::size_t blocks = count(lines, 0); blocks > 0; --blocks) {
    lines.need_next("a node block");
    std::vector<std::int64_t> numbers;
    for (std::size_t left = count(lines, 3); left > 0; --left) {
      lines.need_next("a node number");
      numbers.push_back(lines.integer(0));
    }
    for (const auto number : numbers) {
      lines.need_next("a node's coordinates");
      found.add_node(lines, number, lines.position(0));
    }
  }
}

void read_msh4_elements(Lines& lines, Elements& found) {
  lines.need_next("the number of element blocks");
  for (std::size_t blocks = count(lines, 0); blocks > 0; --blocks) {
    lines.need_next("an element block");
    const auto type = lines.integer(2);
    for (std::size_t left = count(lines, 3); left > 0; --left) {
      lines.need_next("an element");
      found.add_element(lines, type, 1);
    }
  }
}

Elements read_msh(const std::filesystem::path& file) {
  Lines lines(file);
  Elements found;
  lines.need_next("$MeshFormat");
  if (lines.words()[0] != "$MeshFormat") lines.refuse("`" + lines.words()[0] + "`", "$MeshFormat");
  const bool version4 = read_msh_format(lines);
  while (lines.next()) {
    if (lines.words()[0] == "$Nodes")
      version4 ? read_msh4_nodes(lines, found) : read_msh2_nodes(lines, found);
    else if (lines.words()[0] == "$Elements")
      version4 ? read_msh4_elements(lines, found) : read_msh2_elements(lines, found);
  }
  return found;
}

Elements read_tetgen(std::filesystem::path file) {
  Elements found;
  Lines points(file.replace_extension(".node"));
  points.need_next("the number of points");
  if (points.words().size() > 1 && points.integer(1) != 3)
    points.refuse("dimension " + points.words()[1], "3");
  for (std::size_t left = count(points, 0); left > 0; --left) {
    points.need_next("a point");
    found.add_node(points, points.integer(0), points.position(1));
  }
  Lines elements(file.replace_extension(".ele"));
  elements.need_next("the number of tetrahedra");
  if (elements.words().size() > 1 && elements.integer(1) != 4)
    elements.refuse(elements.words()[1] + " nodes per tetrahedron", "4");
  for (std::size_t left = count(elements, 0); left > 0; --left) {
    elements.need_next("a tetrahedron");
    found.tets.push_back(found.nodes<4>(elements, 1));
  }
  return found;
}

/// "f 1/2/3 4//5 6": node numbers are from 1, negative ones count from the last vertex so far.
std::array<int, 3> obj_face(const Lines& lines, std::size_t nodes) {
  const auto& words = lines.words();
  if (words.size() != 4) lines.refuse(fmt::format("a face of {} nodes", words.size() - 1), "triangles");
  std::array<int, 3> face{};
  for (std::size_t i = 0; i < 3; ++i) {
    std::int64_t number = 0;
    try {
      number = std::stoll(words[i + 1].substr(0, words[i + 1].find('/')));
    } catch (const std::logic_error&) {
      lines.refuse("`" + words[i + 1] + "`", "a vertex number");
    }
    const auto from_zero = number < 0 ? static_cast<std::int64_t>(nodes) + number : number - 1;
    if (from_zero < 0 || from_zero >= static_cast<std::int64_t>(nodes))
      lines.refuse(fmt::format("vertex {}", number), fmt::format("a vertex from 1 to {}", nodes));
    face[i] = static_cast<int>(from_zero);
  }
  if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0])
    lines.refuse("a face with a vertex twice", "different vertices");
  return face;
}

Elements read_obj(const std::filesystem::path& file) {
  Lines lines(file);
  Elements found;
  while (lines.next()) {
    if (lines.words()[0] == "v") found.x.push_back(lines.position(1));
    if (lines.words()[0] == "f") found.triangles.push_back(obj_face(lines, found.x.size()));
  }
  return found;
}

Elements read_off(const std::filesystem::path& file) {
  Lines lines(file);
  Elements found;
  lines.need_next("OFF");
  if (lines.words()[0] != "OFF") lines.refuse("`" + lines.words()[0] + "`", "OFF");
  std::size_t first = 1;  // the counts may stand on the header's line
  if (lines.words().size() == 1) {
    lines.need_next("the numbers of vertices and faces");
    first = 0;
  }
  const std::size_t vertices = count(lines, first);
  const std::size_t faces = count(lines, first + 1);
  for (std::size_t i = 0; i < vertices; ++i) {
    lines.need_next("a vertex");
    found.add_node(lines, static_cast<std::int64_t>(i), lines.position(0));
  }
  for (std::size_t i = 0; i < faces; ++i) {
    lines.need_next("a face");
    if (lines.integer(0) != 3) lines.refuse(lines.words()[0] + " nodes in a face", "3, a triangle");
    found.triangles.push_back(found.nodes<3>(lines, 1));
  }
  return found;
}

Elements read(const std::filesystem::path& file) {
  const auto extension = file.extension();
  if (extension == ".msh") return read_msh(file);
  if (extension == ".node" || extension == ".ele") return read_tetgen(file);
  if (extension == ".obj") return read_obj(file);
  if (extension == ".off") return read_off(file);
  throw pbd::SetupError(file.string(), "extension `" + extension.string() + "`",
                        ".msh, .node, .ele, .obj or .off");
}

/// The positions the elements use, in the file's order; renumbers the elements.
template <std::size_t K>
pbd::Points used_nodes(const Elements& found, std::vector<std::array<int, K>>& elements) {
  std::vector<int> index(found.x.size(), -1);
  for (const auto& element : elements)
    for (const int node : element) index[static_cast<std::size_t>(node)] = 0;
  pbd::Points x(3, std::count(index.begin(), index.end(), 0));
  int used = 0;
  for (std::size_t i = 0; i < index.size(); ++i)
    if (index[i] == 0) {
      index[i] = used;
      x.col(used++) = pbd::Vec3::Map(found.x[i].data());
    }
  for (auto& element : elements)
    for (int& node : element) node = index[static_cast<std::size_t>(node)];
  return x;
}

}  // namespace

pbd::TetMesh read_tet_mesh(const std::filesystem::path& file) {
  Elements found = read(file);
  if (found.tets.empty()) throw pbd::SetupError(file.string(), "no tetrahedra", "a mesh with tetrahedra");
  pbd::Points x = used_nodes(found, found.tets);
  return {std::move(x), std::move(found.tets)};
}

pbd::TriangleMesh read_triangle_mesh(const std::filesystem::path& file) {
  Elements found = read(file);
  if (found.triangles.empty()) throw pbd::SetupError(file.string(), "no triangles", "a mesh with triangles");
  pbd::Points x = used_nodes(found, found.triangles);
  return {std::move(x), std::move(found.triangles)};
}

}  // namespace pbdcheck
