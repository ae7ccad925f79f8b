#include "boundary.h"

#include <algorithm>
#include <map>

namespace pbd {

std::vector<std::array<int, 3>> boundary(const TetMesh& mesh) {
  constexpr std::array<std::array<std::size_t, 3>, 4> faces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  struct Face {
    std::array<int, 3> node;
    int count = 0;
  };
  std::map<std::array<int, 3>, Face> found;  // by their sorted nodes
  for (const auto& tet : mesh.tets)
    for (const auto& [i, j, k] : faces) {
      const std::array node{tet[i], tet[j], tet[k]};
      auto sorted = node;
      std::sort(sorted.begin(), sorted.end());
      Face& face = found[sorted];
      face.node = node;
      ++face.count;
    }
  std::vector<std::array<int, 3>> alone;
  for (const auto& [sorted, face] : found)
    if (face.count == 1) alone.push_back(face.node);
  return alone;
}

}  // namespace pbd
