#include "studies/iteration/deformable_contacts.h"

#include <fmt/format.h>

#include <stdexcept>

#include "harness/files.h"
#include "harness/interrupt.h"
#include "scenes/scene_file.h"

namespace pbdcheck {
namespace {

using namespace pbd;

/// The step after `steps` steps of a scene file with settings.
DeformableContact after(std::int64_t steps, std::string name, std::string_view file,
                        std::vector<std::string> settings) {
  settings.insert(settings.end(), {"method.relaxation=direct", "method.tolerance=1e-8"});
  SceneFile made = read_scene_file(scenes_folder() / fmt::format("{}.toml", file), settings);
  Workspace workspace = made.workspace();
  State state = made.scene.initial;
  for (std::int64_t k = 1; k <= steps; ++k) {
    throw_if_interrupted();
    if (const Report report = step(workspace, made.step_s, state); report.status != Status::ok)
      throw std::runtime_error(fmt::format("{}: step {} is not solved: {}", name, k, report.reason));
  }
  made.scene.initial = state;
  return {std::move(name), std::move(made.scene), made.step_s};
}

}  // namespace

std::vector<DeformableContact> deformable_contacts() {
  const std::vector<std::string> placed{"solid.0.cells=[2, 2, 1]",
                                        "rigid_body.1.position_m=[0.03, 0.02, 0.277]",
                                        "rigid_body.1.rotation_rad=[0, 0, 0]"};
  std::vector<std::string> thrown = placed;
  thrown.insert(thrown.end(), {"solid.0.velocity_m_s=[2, 0, 0]", "rigid_body.1.velocity_m_s=[2, 0, 0]"});
  return {
      after(150, "box at rest on a soft block", "box_on_soft_block", placed),
      after(10, "soft block slides under a box", "box_on_soft_block", thrown),
      after(1, "box strikes a cloth", "soft_block_on_box_on_cloth",
            {"cloth.0.cells=[6, 6]", "solid.0.cells=[1, 1, 1]", "rigid_body.0.velocity_m_s=[0.5, 0, -1]"})};
}

}  // namespace pbdcheck
