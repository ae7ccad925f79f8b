#include "scenes/mesh_readers.h"

namespace pbdcheck {

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
  const std::size_t vertices = lines.count(first);
  const std::size_t faces = lines.count(first + 1);
  lines.for_each(vertices, "a vertex", [&] {
    lines.need_words(3, "x, y, z of a vertex");
    found.add_node(lines, static_cast<std::int64_t>(found.x.size()), lines.position(0));
  });
  lines.for_each(faces, "a face", [&] {
    if (lines.integer(0) != 3) lines.refuse(lines.words()[0] + " nodes in a face", "3, a triangle");
    lines.need_words(4, 8, "4 to 8: 3, three vertices, then at most a colour");
    for (std::size_t k = 4; k < lines.words().size(); ++k) lines.number(k);
    found.add(lines, 1);
  });
  lines.need_end();
  return found;
}

}  // namespace pbdcheck
