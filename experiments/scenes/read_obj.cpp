#include "scenes/choices.h"
#include "scenes/mesh_readers.h"

namespace pbdcheck {
namespace {

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

}  // namespace

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

}  // namespace pbdcheck
