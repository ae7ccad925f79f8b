#include "mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <unordered_map>

#include "choices.h"
#include "error.h"
#include "lines.h"

namespace pbdcheck {
namespace {

/// What a file holds: nodes, and elements of K nodes (3 triangles, 4 tetrahedra) by the nodes' places in `x`.
template <std::size_t K>
class Elements {
 public:
  std::vector<std::array<double, 3>> x;
  std::vector<std::array<int, K>> nodes;

  void add_node(const Lines& lines, std::int64_t number, const std::array<double, 3>& position) {
    if (!index_of_.emplace(number, static_cast<int>(x.size())).second)
      lines.refuse(fmt::format("node {} twice", number), "each node once");
    x.push_back(position);
  }

  /// An element of the nodes with these numbers in the file.
  void add(const Lines& lines, const std::array<std::int64_t, K>& numbers) {
    std::array<int, K> element{};
    for (std::size_t i = 0; i < K; ++i) {
      const auto entry = index_of_.find(numbers[i]);
      if (entry == index_of_.end()) lines.refuse(fmt::format("node {}", numbers[i]), "a node of this file");
      element[i] = entry->second;
      if (std::find(element.begin(), element.begin() + i, element[i]) != element.begin() + i)
        lines.refuse(fmt::format("node {} twice in an element", numbers[i]), "different nodes");
    }
    nodes.push_back(element);
    std::sort(element.begin(), element.end());
    if (!known_.insert(element).second)
      lines.refuse("an element of the same nodes as one before", "each element once");
  }

  /// An element of the nodes that the words from `first` on name.
  void add(const Lines& lines, std::size_t first) {
    std::array<std::int64_t, K> numbers{};
    for (std::size_t i = 0; i < K; ++i) numbers[i] = lines.integer(first + i);
    add(lines, numbers);
  }

 private:
  std::unordered_map<std::int64_t, int> index_of_;  // of a node's number in the file
  std::set<std::array<int, K>> known_;              // sorted nodes of each element
};

std::size_t count(const Lines& lines, std::size_t index) {
  const auto value = lines.integer(index);
  if (value < 0) lines.refuse(fmt::format("{}", value), "a count >= 0");
  return static_cast<std::size_t>(value);
}

/// A count that may be left out.
std::size_t count_or_none(const Lines& lines, std::size_t index) {
  return index < lines.words().size() ? count(lines, index) : 0;
}

void need_words(const Lines& lines, std::size_t expected, std::string_view meaning) {
  lines.need_words(expected, expected, fmt::format("{}: {}", expected, meaning));
}

struct MshType {
  std::string_view name;
  int dimension;
};
/// Gmsh's element types of first and second order, from type 1.
constexpr std::array<MshType, 19> msh_types{{{"line", 1},
                                             {"triangle", 2},
                                             {"quadrangle", 2},
                                             {"tetrahedron", 3},
                                             {"hexahedron", 3},
                                             {"prism", 3},
                                             {"pyramid", 3},
                                             {"second-order line", 1},
                                             {"second-order triangle", 2},
                                             {"second-order quadrangle", 2},
                                             {"second-order tetrahedron", 3},
                                             {"second-order hexahedron", 3},
                                             {"second-order prism", 3},
                                             {"second-order pyramid", 3},
                                             {"point", 0},
                                             {"second-order quadrangle", 2},
                                             {"second-order hexahedron", 3},
                                             {"second-order prism", 3},
                                             {"second-order pyramid", 3}}};

/// Whether elements of this type are those of K nodes; false where they are of another dimension.
template <std::size_t K>
bool is_wanted(const Lines& lines, std::int64_t type) {
  constexpr std::int64_t wanted = K == 4 ? 4 : 2;
  constexpr auto allowed = K == 4 ? "type 4, tetrahedra of 4 nodes" : "type 2, triangles of 3 nodes";
  if (type < 1 || type > static_cast<std::int64_t>(msh_types.size()))
    lines.refuse(fmt::format("element type {}", type), allowed);
  const auto& [name, dimension] = msh_types[static_cast<std::size_t>(type - 1)];
  if (dimension == K - 1 && type != wanted)
    lines.refuse(fmt::format("element type {}, {}", type, name), allowed);
  return type == wanted;
}

bool read_msh_format(Lines& lines) {
  lines.need_next("the line after $MeshFormat");
  need_words(lines, 3, "version, file type, data size");
  const std::string version = lines.words()[0];
  if (lines.integer(1) != 0) lines.refuse("a binary mesh", "an ASCII one (gmsh -format msh41 -bin 0)");
  if (version != "2.2" && version != "4.1") lines.refuse("MSH version " + version, "2.2 or 4.1");
  return version == "4.1";
}

template <std::size_t K>
void read_msh2_nodes(Lines& lines, Elements<K>& found) {
  lines.need_next("the number of nodes");
  need_words(lines, 1, "the number of nodes");
  for (std::size_t left = count(lines, 0); left > 0; --left) {
    lines.need_next("a node");
    need_words(lines, 4, "a node's number, x, y, z");
    found.add_node(lines, lines.integer(0), lines.position(1));
  }
}

template <std::size_t K>
void read_msh2_elements(Lines& lines, Elements<K>& found) {
  lines.need_next("the number of elements");
  need_words(lines, 1, "the number of elements");
  for (std::size_t left = count(lines, 0); left > 0; --left) {
    lines.need_next("an element");
    if (!is_wanted<K>(lines, lines.integer(1))) continue;
    const std::size_t first = 3 + count(lines, 2);
    need_words(lines, first + K, "an element's number, type, number of tags, tags, nodes");
    found.add(lines, first);
  }
}

/// The counts of blocks and of entries that begin a section.
std::array<std::size_t, 2> read_msh4_counts(Lines& lines) {
  lines.need_next("the number of blocks");
  need_words(lines, 4, "the numbers of blocks and of entries, the smallest and the largest number");
  return {count(lines, 0), count(lines, 1)};
}

void need_total(const Lines& lines, std::size_t total, std::size_t announced) {
  if (total != announced)
    lines.refuse(fmt::format("{} entries in the section's blocks", total),
                 fmt::format("{}, as its first line says", announced));
}

template <std::size_t K>
void read_msh4_nodes(Lines& lines, Elements<K>& found) {
  const auto [blocks, announced] = read_msh4_counts(lines);
  for (std::size_t block = 0; block < blocks; ++block) {
    lines.need_next("a node block");
    need_words(lines, 4, "dimension, entity, 1 if parametric, number of nodes");
    const std::size_t parameters = count(lines, 2) == 0 ? 0 : count(lines, 0);
    std::vector<std::int64_t> numbers;
    for (std::size_t left = count(lines, 3); left > 0; --left) {
      lines.need_next("a node number");
      need_words(lines, 1, "a node number");
      numbers.push_back(lines.integer(0));
    }
    for (const auto number : numbers) {
      lines.need_next("a node's coordinates");
      need_words(lines, 3 + parameters, "x, y, z, and as many parameters as the block has dimensions");
      found.add_node(lines, number, lines.position(0));
    }
  }
  need_total(lines, found.x.size(), announced);
}

template <std::size_t K>
void read_msh4_elements(Lines& lines, Elements<K>& found) {
  const auto [blocks, announced] = read_msh4_counts(lines);
  std::size_t total = 0;
  for (std::size_t block = 0; block < blocks; ++block) {
    lines.need_next("an element block");
    need_words(lines, 4, "dimension, entity, element type, number of elements");
    const bool wanted = is_wanted<K>(lines, lines.integer(2));
    for (std::size_t left = count(lines, 3); left > 0; --left, ++total) {
      lines.need_next("an element");
      if (!wanted) continue;
      need_words(lines, 1 + K, "an element's number and its nodes");
      found.add(lines, 1);
    }
  }
  need_total(lines, total, announced);
}

template <std::size_t K>
Elements<K> read_msh(const std::filesystem::path& file) {
  Lines lines(file);
  Elements<K> found;
  lines.need_next("$MeshFormat");
  lines.need_first("$MeshFormat");
  const bool version4 = read_msh_format(lines);
  lines.need_next("$EndMeshFormat");
  lines.need_first("$EndMeshFormat");
  while (lines.next()) {
    const std::string section = lines.words()[0];
    if (!section.starts_with('$') || section.starts_with("$End"))
      lines.refuse("`" + section + "`", "a section's begin, as $Nodes");
    const std::string end = "$End" + section.substr(1);
    if (section == "$Nodes")
      version4 ? read_msh4_nodes(lines, found) : read_msh2_nodes(lines, found);
    else if (section == "$Elements")
      version4 ? read_msh4_elements(lines, found) : read_msh2_elements(lines, found);
    lines.need_next(end);
    while (section != "$Nodes" && section != "$Elements" && lines.words()[0] != end) lines.need_next(end);
    lines.need_first(end);
  }
  return found;
}

Elements<4> read_tetgen(std::filesystem::path file) {
  Elements<4> found;
  Lines points(file.replace_extension(".node"));
  points.need_next("the number of points");
  points.need_words(1, 4, "the numbers of points, dimensions (3), attributes and boundary markers");
  if (points.words().size() > 1 && points.integer(1) != 3)
    points.refuse("dimension " + points.words()[1], "3");
  const std::size_t point_words = 4 + count_or_none(points, 2) + count_or_none(points, 3);
  for (std::size_t left = count(points, 0); left > 0; --left) {
    points.need_next("a point");
    need_words(points, point_words, "a point's number, x, y, z, attributes, marker");
    found.add_node(points, points.integer(0), points.position(1));
  }
  points.need_end();
  Lines elements(file.replace_extension(".ele"));
  elements.need_next("the number of tetrahedra");
  elements.need_words(1, 3, "the numbers of tetrahedra, nodes of each (4) and attributes");
  if (elements.words().size() > 1 && elements.integer(1) != 4)
    elements.refuse(elements.words()[1] + " nodes per tetrahedron", "4 (tetgen without -o2)");
  const std::size_t element_words = 5 + count_or_none(elements, 2);
  for (std::size_t left = count(elements, 0); left > 0; --left) {
    elements.need_next("a tetrahedron");
    need_words(elements, element_words, "a tetrahedron's number, its nodes, attributes");
    found.add(elements, 1);
  }
  elements.need_end();
  return found;
}

/// The vertex of "1/2/3", "4//5" or "6": numbers are from 1, negative ones count from the last vertex so far.
std::int64_t obj_vertex(const Lines& lines, const std::string& word, std::size_t vertices) {
  const auto slash = std::min(word.find('/'), word.size());
  for (auto begin = slash; begin < word.size();) {
    const auto end = std::min(word.find('/', begin + 1), word.size());
    if (end > begin + 1) lines.integer(std::string_view(word).substr(begin + 1, end - begin - 1));
    begin = end;
  }
  const auto number = lines.integer(std::string_view(word).substr(0, slash));
  const auto last = static_cast<std::int64_t>(vertices);
  return number < 0 && number >= -last ? last + 1 + number : number;
}

Elements<3> read_obj(const std::filesystem::path& file) {
  static const std::vector<std::string> skipped{"vt", "vn", "vp", "p",      "l",
                                                "g",  "o",  "s",  "mtllib", "usemtl"};
  Lines lines(file);
  Elements<3> found;
  while (lines.next()) {
    const auto& words = lines.words();
    if (words[0] == "v") {
      lines.need_words(4, 7, "4 to 7: v, x, y, z, then at most a weight or a colour");
      for (std::size_t i = 4; i < words.size(); ++i) lines.number(i);
      found.add_node(lines, static_cast<std::int64_t>(found.x.size()) + 1, lines.position(1));
    } else if (words[0] == "f") {
      if (words.size() != 4) lines.refuse(fmt::format("a face of {} nodes", words.size() - 1), "triangles");
      std::array<std::int64_t, 3> face{};
      for (std::size_t i = 0; i < 3; ++i) face[i] = obj_vertex(lines, words[i + 1], found.x.size());
      found.add(lines, face);
    } else if (std::find(skipped.begin(), skipped.end(), words[0]) == skipped.end()) {
      lines.refuse("`" + words[0] + "`", "v or f; skipped are " + joined(skipped));
    }
  }
  return found;
}

Elements<3> read_off(const std::filesystem::path& file) {
  Lines lines(file);
  Elements<3> found;
  lines.need_next("OFF");
  lines.need_first("OFF");
  std::size_t first = 1;  // the counts may stand on the header's line
  if (lines.words().size() == 1) {
    lines.need_next("the numbers of vertices and faces");
    first = 0;
  }
  lines.need_words(first + 2, first + 3, "the numbers of vertices, faces and edges");
  const std::size_t vertices = count(lines, first);
  const std::size_t faces = count(lines, first + 1);
  for (std::size_t i = 0; i < vertices; ++i) {
    lines.need_next("a vertex");
    need_words(lines, 3, "a vertex' x, y, z");
    found.add_node(lines, static_cast<std::int64_t>(i), lines.position(0));
  }
  for (std::size_t i = 0; i < faces; ++i) {
    lines.need_next("a face");
    if (lines.integer(0) != 3) lines.refuse(lines.words()[0] + " nodes in a face", "3, a triangle");
    lines.need_words(4, 8, "4 to 8: 3, three vertices, then at most a colour");
    for (std::size_t k = 4; k < lines.words().size(); ++k) lines.number(k);
    found.add(lines, 1);
  }
  lines.need_end();
  return found;
}

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

}  // namespace pbdcheck
