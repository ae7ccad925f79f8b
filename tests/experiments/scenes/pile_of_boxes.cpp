#include <catch2/catch.hpp>

#include "harness/files.h"
#include "scenes/scene_file.h"

using namespace pbd;
using namespace pbdcheck;

TEST_CASE("a sweep of the augmented Lagrangian brings a pile that strikes nearer from no impulses") {
  const SceneFile file = read_scene_file(scenes_folder() / "boxes_on_ground.toml");
  const auto method_of = [&](const char* settings) { return parse_method(settings, file.method, ""); };
  Workspace rough(file.scene, method_of("outer=plain max_outer=5 max_sweeps=100"));
  State state = file.scene.initial;
  while (state.time < 0.7) step(rough, file.step_s, state);
  Workspace workspace(file.scene, method_of("relaxation=augmented_lagrangian max_outer=1 max_sweeps=1"));
  std::vector<double> dual;
  step(workspace, file.step_s, state, [&](const Iterate& at) { dual.push_back(at.dual); });
  REQUIRE(dual.size() == 2);
  CHECK(dual[1] < dual[0]);
}
