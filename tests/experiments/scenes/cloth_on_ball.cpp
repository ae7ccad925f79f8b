#include <catch2/catch.hpp>

#include "harness/files.h"
#include "scenes/scene_file.h"

using namespace pbd;
using namespace pbdcheck;

// A few contacts on the ball are all but redundant while the cloth slides off it.
TEST_CASE("direct solves each step of a cloth that slides off a ball, with slightly different friction") {
  const std::string friction = GENERATE("0.500000003", "0.500000004", "0.500000007");
  CAPTURE(friction);
  SceneFile file =
      read_scene_file(scenes_folder() / "cloth_on_ball.toml",
                      {"method.relaxation=direct", "method.tolerance=1e-8", "contact.friction=" + friction});
  Workspace workspace = file.workspace();
  State state = file.scene.initial;
  while (state.time < 0.36) {
    CAPTURE(state.time);
    REQUIRE(step(workspace, file.step_s, state).status == Status::ok);
  }
}
