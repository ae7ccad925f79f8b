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

// The frame that its legs are pressed flat in takes more than thirty iterations by the metric of its rest
// shape.
TEST_CASE("a cow of 3432 tetrahedra that strikes the ground is solved at every step") {
  const TemporaryFolder folder;
  const SizedScene sized = sized_scene("flexible_cow", 0, folder.path);
  REQUIRE(sized.size == 3432);
  pbd::Workspace workspace = sized.file.workspace();
  pbd::State state = sized.file.scene.initial;
  for (int k = 1; k <= 39; ++k) {
    INFO("step " << k);
    CHECK(step(workspace, sized.file.step_s, state).status == pbd::Status::ok);
  }
}
