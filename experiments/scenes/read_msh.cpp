#include "scenes/mesh_readers.h"

namespace pbdcheck {
namespace {

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
  lines.need_words(3, "version, file type, data size");
  const std::string version = lines.words()[0];
  if (lines.integer(1) != 0) lines.refuse("a binary mesh", "an ASCII one (gmsh -format msh41 -bin 0)");
  if (version != "2.2" && version != "4.1") lines.refuse("MSH version " + version, "2.2 or 4.1");
  return version == "4.1";
}

/// The only number on the next line.
std::size_t read_count(Lines& lines, std::string_view meaning) {
  lines.need_next(meaning);
  lines.need_words(1, meaning);
  return lines.count(0);
}

template <std::size_t K>
void read_msh2_nodes(Lines& lines, Elements<K>& found) {
  lines.for_each(read_count(lines, "the number of nodes"), "a node", [&] {
    lines.need_words(4, "a node's number, x, y, z");
    found.add_node(lines, lines.integer(0), lines.position(1));
  });
}

template <std::size_t K>
void read_msh2_elements(Lines& lines, Elements<K>& found) {
  lines.for_each(read_count(lines, "the number of elements"), "an element", [&] {
    if (!is_wanted<K>(lines, lines.integer(1))) return;
    const std::size_t first = 3 + lines.count(2);
    lines.need_words(first + K, "an element's number, type, number of tags, tags, nodes");
    found.add(lines, first);
  });
}

/// The counts of blocks and of entries that begin a section.
std::array<std::size_t, 2> read_msh4_counts(Lines& lines) {
  lines.need_next("the number of blocks");
  lines.need_words(4, "the numbers of blocks and of entries, the smallest and the largest number");
  return {lines.count(0), lines.count(1)};
}

void need_total(const Lines& lines, std::size_t total, std::size_t announced) {
  if (total != announced)
    lines.refuse(fmt::format("{} entries in the section's blocks", total),
                 fmt::format("{}, as its first line says", announced));
}

template <std::size_t K>
void read_msh4_nodes(Lines& lines, Elements<K>& found) {
  const auto [blocks, announced] = read_msh4_counts(lines);
  lines.for_each(blocks, "a node block", [&] {
    lines.need_words(4, "dimension, entity, 1 if parametric, number of nodes");
    const std::size_t parameters = lines.count(2) == 0 ? 0 : lines.count(0);
    std::vector<std::int64_t> numbers;
    lines.for_each(lines.count(3), "a node number", [&] {
      lines.need_words(1, "a node number");
      numbers.push_back(lines.integer(0));
    });
    for (const auto number : numbers) {
      lines.need_next("a node's coordinates");
      lines.need_words(3 + parameters, "x, y, z, and as many parameters as the block has dimensions");
      found.add_node(lines, number, lines.position(0));
    }
  });
  need_total(lines, found.x.size(), announced);
}

template <std::size_t K>
void read_msh4_elements(Lines& lines, Elements<K>& found) {
  const auto [blocks, announced] = read_msh4_counts(lines);
  std::size_t total = 0;
  lines.for_each(blocks, "an element block", [&] {
    lines.need_words(4, "dimension, entity, element type, number of elements");
    const bool wanted = is_wanted<K>(lines, lines.integer(2));
    lines.for_each(lines.count(3), "an element", [&] {
      ++total;
      if (!wanted) return;
      lines.need_words(1 + K, "an element's number and its nodes");
      found.add(lines, 1);
    });
  });
  need_total(lines, total, announced);
}

}  // namespace

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

template Elements<3> read_msh(const std::filesystem::path&);
template Elements<4> read_msh(const std::filesystem::path&);

}  // namespace pbdcheck
