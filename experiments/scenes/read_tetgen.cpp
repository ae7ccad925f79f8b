#include "scenes/mesh_readers.h"

namespace pbdcheck {

Elements<4> read_tetgen(std::filesystem::path file) {
  Elements<4> found;
  Lines points(file.replace_extension(".node"));
  points.need_next("the number of points");
  points.need_words(1, 4, "the numbers of points, dimensions (3), attributes and boundary markers");
  if (points.words().size() > 1 && points.integer(1) != 3)
    points.refuse("dimension " + points.words()[1], "3");
  const std::size_t point_words = 4 + points.count_or_none(2) + points.count_or_none(3);
  points.for_each(points.count(0), "a point", [&] {
    points.need_words(point_words, "a point's number, x, y, z, attributes, marker");
    found.add_node(points, points.integer(0), points.position(1));
  });
  points.need_end();
  Lines elements(file.replace_extension(".ele"));
  elements.need_next("the number of tetrahedra");
  elements.need_words(1, 3, "the numbers of tetrahedra, nodes of each (4) and attributes");
  if (elements.words().size() > 1 && elements.integer(1) != 4)
    elements.refuse(elements.words()[1] + " nodes per tetrahedron", "4 (tetgen without -o2)");
  const std::size_t element_words = 5 + elements.count_or_none(2);
  elements.for_each(elements.count(0), "a tetrahedron", [&] {
    elements.need_words(element_words, "a tetrahedron's number, its nodes, attributes");
    found.add(elements, 1);
  });
  elements.need_end();
  return found;
}

}  // namespace pbdcheck
