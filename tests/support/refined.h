// Finer surfaces.
#pragma once

#include <map>

#include "geometry.h"

namespace pbd::test {

/// Every triangle cut into four.
inline TriangleMesh refined(const TriangleMesh& mesh) {
  TriangleMesh fine{mesh.x, {}};
  std::map<std::array<int, 2>, int> middle;
  const auto between = [&](int i, int j) {
    const auto [at, added] =
        middle.try_emplace({std::min(i, j), std::max(i, j)}, static_cast<int>(fine.x.cols()));
    if (added) {
      fine.x.conservativeResize(3, at->second + 1);
      fine.x.col(at->second) = (mesh.x.col(i) + mesh.x.col(j)) / 2;
    }
    return at->second;
  };
  for (const auto& [i, j, k] : mesh.triangles) {
    const int ij = between(i, j), jk = between(j, k), ki = between(k, i);
    for (const auto& triangle : {std::array{i, ij, ki}, {ij, j, jk}, {ki, jk, k}, {ij, jk, ki}})
      fine.triangles.push_back(triangle);
  }
  return fine;
}

}  // namespace pbd::test
