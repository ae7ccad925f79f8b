// A scene file, read from a text; its meshes are those of the shipped scenes.
#pragma once

#include "program.h"
#include "scenes/scene_file.h"

namespace pbdcheck::test {

inline const std::string two_steps = "[step]\nstep_s = 0.01\nsteps = 2\n";

inline SceneFile read(const std::string& text, const std::vector<std::string>& settings = {}) {
  const TemporaryFolder folder;
  std::filesystem::create_directory_symlink(scenes / "meshes", folder.path / "meshes");
  return read_scene_file(folder.write("scene.toml", text + two_steps), settings);
}

}  // namespace pbdcheck::test
