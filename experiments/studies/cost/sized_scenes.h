// The paper's three scenes from an eighth of their size to eight times it.
#pragma once

#include <array>
#include <filesystem>
#include <string_view>

#include "scenes/scene_file.h"

namespace pbdcheck {

inline constexpr std::array<std::string_view, 3> sized_names{"boxes_on_ground", "bunnies_on_cloth",
                                                             "flexible_cow"};

struct SizedScene {
  SceneFile file;
  std::int64_t size = 0;  // boxes; cells of cloth; tetrahedra
};

inline constexpr int least_level = -3, most_level = 3;

/// About 2^level times as many as the file has. Boxes: more columns and layers of them. Cloth: wider, of the
/// same cells, with bunnies five a square metre. The cow: cubes of another size fill its surface; the mesh
/// goes to a file in `directory`.
SizedScene sized_scene(std::string_view name, int level, const std::filesystem::path& directory);

}  // namespace pbdcheck
