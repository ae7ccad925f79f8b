#include "studies/cost/sized_scenes.h"

#include <catch2/catch.hpp>

#include "program.h"

using namespace pbdcheck;

TEST_CASE("a cow of another size is read from wherever its mesh is written, a relative folder too") {
  const TemporaryFolder folder;
  const SizedScene cow = sized_scene("flexible_cow", least_level, std::filesystem::relative(folder.path));
  const auto& solid = std::get<pbd::TetStrain>(cow.file.scene.effects.front());
  CHECK(std::ssize(solid.node) == cow.size);
}
